// SPDX-License-Identifier: Apache-2.0
#include "images/gltf_images.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <set>
#include <thread>

#include "gltf_error.h"
#include "gltf_uri.h"
#include "images/image_decoder.h"

namespace afm::scene {
namespace {

TextureWrap wrap_of(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return TextureWrap::MirroredRepeat;
  return wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE ? TextureWrap::ClampToEdge : TextureWrap::Repeat;
}

// glTF 2.0, section 3.8.4. Unspecified filters become the best available.
void read_sampler(const tinygltf::Sampler& sampler, Texture& texture) {
  constexpr auto kNearest = TextureFilter::Nearest, kLinear = TextureFilter::Linear;
  texture.magnified = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? kNearest : kLinear;
  switch (sampler.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      texture.minified = kNearest;
      texture.between_mips = std::nullopt;
      break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
      texture.between_mips = std::nullopt;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
      texture.minified = texture.between_mips.emplace(kNearest);
      break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
      texture.between_mips = kNearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
      texture.minified = kNearest;
      break;
    default:
      break;
  }
  texture.wrap_u = wrap_of(sampler.wrapS);
  texture.wrap_v = wrap_of(sampler.wrapT);
}

constexpr std::size_t kLongestNamed = 200;  // bytes of a file name in a message

// Image bytes before decoding.
struct EncodedImage {
  std::string path;  // location such as "/images/0", and the file's name
  Bytes owned;
  std::span<const std::uint8_t> bytes;
};

EncodedImage read_image(GltfModel& model, const GltfBuffers& buffers, std::uint32_t index) {
  EncodedImage image;
  image.path = fmt::format("/images/{}", index);
  const tinygltf::Image& source = model.parts.images[index];
  if (source.bufferView >= 0) {
    image.bytes = buffers.views()[static_cast<std::size_t>(source.bufferView)].bytes;
  } else if (source.uri.empty()) {
    throw GltfMissingFile("it has neither a uri nor a bufferView");
  } else {
    image.owned = model.side_files.read(source.uri);
    if (!is_data_uri(source.uri)) image.path += fmt::format(" '{}'", source.uri.substr(0, kLongestNamed));
    image.bytes = image.owned;
  }
  return image;
}

// Decodes all images; each worker takes the next one until none is left.
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
    } catch (const GltfError& fault) {
      throw GltfError(fmt::format("{} cannot be decoded: {}", encoded[i].path, fault.what()));
    }
  }
}

std::map<std::uint32_t, std::uint32_t> numbered(const std::set<std::uint32_t>& used) {
  std::map<std::uint32_t, std::uint32_t> places;
  for (const std::uint32_t index : used) places.emplace(index, static_cast<std::uint32_t>(places.size()));
  return places;
}

// Checks the sizes of all images before decoding any of them.
void measure(const std::vector<EncodedImage>& encoded, std::vector<Image>& images) {
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    try {
      const ImageSize size = image_size(encoded[i].bytes);
      images[i].width = size.width;
      images[i].height = size.height;
    } catch (const GltfError& fault) {
      throw GltfError(fmt::format("{} cannot be decoded: {}", encoded[i].path, fault.what()));
    }
    pixels += std::uint64_t{images[i].width} * images[i].height;
  }
  if (pixels > kMostImagePixels) {
    throw GltfError(
        fmt::format("its images have {} megapixels in total, more than {}", pixels >> 20U, kMostImagePixels >> 20U));
  }
}

// Replaces the file's texture numbers with the scene's; drops uses without an image.
void renumber(const std::map<std::uint32_t, std::uint32_t>& places, Scene& scene) {
  for (PbrMaterial& material : scene.materials) {
    for (TextureUse& use : material.textures) {
      if (!use.texture) continue;
      const auto found = places.find(*use.texture);
      use.texture = found == places.end() ? std::nullopt : std::optional(found->second);
    }
  }
}

}  // namespace

void read_textures(GltfModel& model, const GltfBuffers& buffers, Scene& scene, GltfWarnings& notes) {
  const std::vector<tinygltf::Texture>& textures = model.parts.textures;
  std::set<std::uint32_t> used_textures, used_images;
  for (const PbrMaterial& material : scene.materials) {
    for (const TextureUse& use : material.textures) {
      if (!use.texture) continue;
      if (const int source = textures[*use.texture].source; source >= 0) {
        used_textures.insert(*use.texture);
        used_images.insert(static_cast<std::uint32_t>(source));
      } else {
        notes.ignore(fmt::format("/textures/{}: has an image only in an unsupported format", *use.texture));
      }
    }
  }
  std::vector<EncodedImage> encoded;
  for (auto i = used_images.begin(); i != used_images.end();) {
    try {
      encoded.push_back(read_image(model, buffers, *i));
      scene.images.emplace_back().name = model.parts.images[*i].name;
      ++i;
    } catch (const GltfMissingFile& fault) {
      notes.miss(fmt::format("/images/{}: {}", *i, fault.what()));
      i = used_images.erase(i);
    }
  }
  std::erase_if(used_textures,
                [&](std::uint32_t i) { return !used_images.contains(static_cast<std::uint32_t>(textures[i].source)); });

  const auto places = numbered(used_images);
  for (const std::uint32_t i : used_textures) {
    Texture& texture = scene.textures.emplace_back();
    texture.image = places.at(static_cast<std::uint32_t>(textures[i].source));
    const int sampler = textures[i].sampler;
    if (sampler >= 0) read_sampler(model.parts.samplers[static_cast<std::size_t>(sampler)], texture);
  }
  renumber(numbered(used_textures), scene);
  measure(encoded, scene.images);
  decode_all(encoded, scene.images);
}

}  // namespace afm::scene
