// SPDX-License-Identifier: Apache-2.0
#include "gltf_images.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <set>
#include <thread>

#include "gltf_fault.h"
#include "image_decoder.h"

namespace afm::scene {
namespace {

TextureWrap wrap_of(const JsonElement& sampler, const char* key) {
  switch (sampler.size(key, 10497, 65535)) {
    case 10497:
      return TextureWrap::Repeat;
    case 33648:
      return TextureWrap::MirroredRepeat;
    case 33071:
      return TextureWrap::ClampToEdge;
    default:
      sampler.fail("has a wrap mode that glTF does not know");
  }
}

// glTF 2.0, section 3.8.4: OpenGL's numbers.
void read_sampler(const JsonElement& sampler, Texture& texture) {
  constexpr auto kNearest = TextureFilter::Nearest, kLinear = TextureFilter::Linear;
  const std::uint64_t magnified = sampler.size("magFilter", 9729, 65535);
  if (magnified != 9728 && magnified != 9729) sampler.fail("has a magFilter that glTF does not know");
  texture.magnified = magnified == 9728 ? kNearest : kLinear;
  const std::uint64_t minified = sampler.size("minFilter", 9987, 65535);
  if (minified != 9728 && minified != 9729 && (minified < 9984 || minified > 9987)) {
    sampler.fail("has a minFilter that glTF does not know");
  }
  texture.minified = minified % 2 == 0 ? kNearest : kLinear;
  texture.between_mips = std::nullopt;
  if (minified >= 9984) texture.between_mips = minified >= 9986 ? kLinear : kNearest;
  texture.wrap_u = wrap_of(sampler, "wrapS");
  texture.wrap_v = wrap_of(sampler, "wrapT");
}

// An image's bytes before they are decoded.
struct EncodedImage {
  std::string path;
  Bytes owned;
  std::span<const std::uint8_t> bytes;
};

EncodedImage read_image(GltfFile& file, const GltfBuffers& buffers, const JsonElement& element) {
  EncodedImage image;
  if (element.has("uri") == element.has("bufferView")) element.fail("has not just one of 'uri' and 'bufferView'");
  if (element.has("uri")) {
    image.owned = file.side_files.read(element.required_text("uri"));
    image.bytes = image.owned;
  } else {
    image.bytes = buffers.views()[element.required_index("bufferView", buffers.views().size())].bytes;
  }
  return image;
}

// Each worker takes the next image until there is none left.
void decode_all(const std::vector<EncodedImage>& encoded, std::vector<Image>& images) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> faults(images.size());
  const auto work = [&] {
    for (std::size_t i = next++; i < images.size(); i = next++) {
      try {
        decode_image(encoded[i].bytes, images[i]);
      } catch (...) {
        faults[i] = std::current_exception();
      }
    }
  };
  std::vector<std::jthread> workers;
  const std::size_t cores = std::max<std::size_t>(1, std::thread::hardware_concurrency());
  for (std::size_t i = 1; i < std::min(cores, images.size()); ++i) workers.emplace_back(work);
  work();
  workers.clear();
  for (std::size_t i = 0; i < faults.size(); ++i) {
    try {
      if (faults[i]) std::rethrow_exception(faults[i]);
    } catch (const GltfFault& fault) {
      throw GltfFault(fmt::format("{} cannot be decoded: {}", encoded[i].path, fault.what()));
    }
  }
}

std::map<std::uint32_t, std::uint32_t> numbered(const std::set<std::uint32_t>& used) {
  std::map<std::uint32_t, std::uint32_t> places;
  for (const std::uint32_t index : used) places.emplace(index, static_cast<std::uint32_t>(places.size()));
  return places;
}

// The images' sizes are bounded before the first of them is decoded.
void measure(const std::vector<EncodedImage>& encoded, std::vector<Image>& images) {
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    try {
      const ImageSize size = image_size(encoded[i].bytes);
      images[i].width = size.width;
      images[i].height = size.height;
    } catch (const GltfFault& fault) {
      throw GltfFault(fmt::format("{} cannot be decoded: {}", encoded[i].path, fault.what()));
    }
    pixels += std::uint64_t{images[i].width} * images[i].height;
  }
  if (pixels > kMostImagePixels) {
    throw GltfFault(
        fmt::format("its images have {} megapixels together, more than {}", pixels >> 20U, kMostImagePixels >> 20U));
  }
}

// Replaces the file's numbers of textures by the scene's; drops the uses of those that have no image.
void renumber(const std::map<std::uint32_t, std::uint32_t>& places, Scene& scene) {
  for (Material& material : scene.materials) {
    for (TextureUse& use : material.textures) {
      if (!use.texture) continue;
      const auto found = places.find(*use.texture);
      use.texture = found == places.end() ? std::nullopt : std::optional(found->second);
    }
  }
}

}  // namespace

void read_textures(GltfFile& file, const GltfBuffers& buffers, const JsonElement& root, Scene& scene,
                   GltfNotes& notes) {
  const std::vector<JsonElement> samplers = root.objects("samplers"), images = root.objects("images"),
                                 textures = root.objects("textures");
  std::vector<std::optional<std::uint32_t>> sources;
  for (const JsonElement& texture : textures) sources.push_back(texture.index("source", images.size()));
  std::set<std::uint32_t> used_textures, used_images;
  for (const Material& material : scene.materials) {
    for (const TextureUse& use : material.textures) {
      if (!use.texture) continue;
      if (const auto source = sources[*use.texture]) {
        used_textures.insert(*use.texture);
        used_images.insert(*source);
      } else {
        notes.ignore(fmt::format("/textures/{}: has an image only in a format that is not read", *use.texture));
      }
    }
  }

  const auto places = numbered(used_images);
  for (const std::uint32_t i : used_textures) {
    Texture& texture = scene.textures.emplace_back();
    texture.image = places.at(*sources[i]);
    if (const auto sampler = textures[i].index("sampler", samplers.size())) read_sampler(samplers[*sampler], texture);
  }
  std::vector<EncodedImage> encoded;
  for (const std::uint32_t i : used_images) {
    encoded.push_back(read_image(file, buffers, images[i]));
    encoded.back().path = fmt::format("/images/{}", i);
    scene.images.emplace_back().name = images[i].text("name", "");
  }
  renumber(numbered(used_textures), scene);
  measure(encoded, scene.images);
  decode_all(encoded, scene.images);
}

}  // namespace afm::scene
