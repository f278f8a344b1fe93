// SPDX-License-Identifier: Apache-2.0
#include "gltf_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "gltf_error.h"

namespace afm::scene {
namespace {

// Checks the header first, because the other rules depend on the version.
void check_header(const Json& document, GltfWarnings& notes) {
  const Json& asset = document["asset"];
  const std::string version = asset["version"];
  if (version.rfind("2.", 0) != 0) {
    throw GltfError(fmt::format("it is glTF of version '{}'; export it as glTF 2.0", version.substr(0, 20)));
  }
  if (const std::string least = asset.value("minVersion", "2.0"); least != "2.0") {
    throw GltfError(
        fmt::format("it needs a reader of glTF '{}' (minVersion); export it as glTF 2.0", least.substr(0, 20)));
  }
  notes.generator = asset.value("generator", "");
  const std::set<std::string_view> understood = gltf_extensions();
  std::string refused;
  for (const std::string name : document.value("extensionsRequired", Json::array())) {
    if (!understood.contains(name)) refused += fmt::format("{}'{}'", refused.empty() ? "" : ", ", name.substr(0, 80));
  }
  if (!refused.empty()) {
    throw GltfError(
        fmt::format("it requires {}, which TouchAFM does not support; export it without (docs/gltf.md lists the "
                    "supported extensions)",
                    refused));
  }
  for (const std::string name : document.value("extensionsUsed", Json::array())) {
    if (understood.contains(name)) {
      notes.extensions.push_back(name);
    } else {
      notes.ignore(fmt::format("{}: not supported, and not required to show the model", name));
    }
  }
}

// Changes the document before tinygltf parses it. The URIs of buffers and images are replaced by numbers that
// read_buffer() answers, so that tinygltf opens and decodes nothing itself. Valid constructs that tinygltf 2.7 rejects
// are changed too, and restored in the model afterwards:
// - a buffer of no bytes, or without a URI and not a .glb's first (a placeholder for compressed data), becomes one
// byte;
// - indices in an accessor without a view (zeros, or a Draco stream) get a view that does not exist;
// - an animation's channel that moves no node is removed.
class Exchange {
 public:
  Exchange(GltfFile& file, GltfWarnings& notes) : file_(file) {
    Json& document = file.document;
    if (document.contains("buffers")) take_buffers(document["buffers"]);
    if (document.contains("images")) take_images(document["images"]);
    views_ = document.contains("bufferViews") ? document["bufferViews"].size() : 0;
    document["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
    if (document.contains("accessors")) {
      for (Json& accessor : document["accessors"]) {
        if (!accessor.contains("bufferView")) accessor["bufferView"] = views_;
      }
    }
    if (document.contains("animations")) {
      for (Json& animation : document["animations"]) leave_out_channels(animation["channels"], notes);
    }
  }

  void give_back(tinygltf::Model& model) {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (sources_[i].kind == Source::Nothing) model.buffers[i].data.clear();
    }
    model.bufferViews.pop_back();
    for (tinygltf::Accessor& accessor : model.accessors) {
      if (static_cast<std::size_t>(accessor.bufferView) == views_) accessor.bufferView = -1;
    }
    for (std::size_t i = 0; i < images_.size(); ++i) {
      model.images[i].uri = std::move(images_[i].uri);
      model.images[i].bufferView = images_[i].view;
    }
  }

  // tinygltf's callback for a file: `name` is a buffer's number.
  static bool read_buffer(Bytes* bytes, std::string*, const std::string& name, void* exchange) {
    return static_cast<Exchange*>(exchange)->read(name, *bytes);
  }
  static bool size_of_buffer(std::size_t* size, std::string*, const std::string& name, void* exchange) {
    const Source* source = static_cast<Exchange*>(exchange)->find(name);
    if (source != nullptr) *size = source->length;
    return source != nullptr;
  }

 private:
  struct Source {
    enum { Nothing, Chunk, Uri } kind = Nothing;
    std::string uri;
    std::uint64_t length = 1;
  };
  struct ImageSource {
    std::string uri;
    int view = -1;
  };

  void take_buffers(Json& buffers) {
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      Source& source = sources_.emplace_back();
      if (buffers[i].contains("uri")) {
        source.kind = Source::Uri;
        source.uri = std::move(buffers[i]["uri"].get_ref<std::string&>());
      } else if (i == 0 && file_.binary) {
        source.kind = Source::Chunk;
      }
      if (buffers[i]["byteLength"] == 0) source.kind = Source::Nothing;
      if (source.kind == Source::Nothing) buffers[i]["byteLength"] = 1;
      source.length = buffers[i]["byteLength"];
      buffers[i]["uri"] = std::to_string(i);
    }
  }

  void take_images(Json& images) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      ImageSource& source = images_.emplace_back();
      if (images[i].contains("uri")) source.uri = std::move(images[i]["uri"].get_ref<std::string&>());
      source.view = images[i].value("bufferView", -1);
      images[i].erase("bufferView");
      images[i]["uri"] = "";
    }
  }

  static void leave_out_channels(Json& channels, GltfWarnings& notes) {
    auto& list = channels.get_ref<Json::array_t&>();
    const auto moves_no_node = [&](const Json& channel) {
      const Json& target = channel["target"];
      const std::string path = target["path"];
      if (target.contains("node") && path != "pointer") return false;
      notes.ignore(fmt::format("animation channel with path '{}': animates no node", path.substr(0, 40)));
      return true;
    };
    list.erase(std::remove_if(list.begin(), list.end(), moves_no_node), list.end());
  }

  const Source* find(const std::string& name) const {
    std::size_t i = 0;
    std::from_chars(name.data(), name.data() + name.size(), i);
    return i < sources_.size() ? &sources_[i] : nullptr;
  }

  bool read(const std::string& name, Bytes& bytes) {
    const Source* found = find(name);
    if (found == nullptr) return false;
    const Source& source = *found;
    const auto i = found - sources_.data();
    if (source.kind == Source::Nothing) bytes.assign(1, 0);
    if (source.kind == Source::Chunk) bytes = std::move(*file_.binary);
    if (source.kind == Source::Uri) bytes = file_.side_files.read(source.uri);
    if (bytes.size() < source.length) {
      throw GltfError(fmt::format("/buffers/{} announces {} bytes but has {}", i, source.length, bytes.size()));
    }
    bytes.resize(source.length);
    return true;
  }

  GltfFile& file_;
  std::vector<Source> sources_;
  std::vector<ImageSource> images_;
  std::size_t views_ = 0;
};

// tinygltf 2.9 (Debian 13) also asks for sizes, and requires the complete set of callbacks.
template <class Callbacks>
Callbacks callbacks_of(Exchange& exchange, Callbacks callbacks) {
  callbacks.FileExists = [](const std::string& name, void*) { return !name.empty(); };
  callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
  callbacks.ReadWholeFile = &Exchange::read_buffer;
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) callbacks.GetFileSizeInBytes = &Exchange::size_of_buffer;
  callbacks.user_data = &exchange;
  return callbacks;
}

}  // namespace

GltfModel read_gltf_model(const std::string& path, GltfWarnings& notes) {
  GltfFile file = read_gltf_file(path);
  check_gltf_header(file.document);
  check_header(file.document, notes);
  check_gltf_document(file.document, notes);
  Exchange exchange(file, notes);
  const std::string text = file.document.dump();
  file.document = Json();

  tinygltf::TinyGLTF reader;
  reader.SetFsCallbacks(callbacks_of(exchange, tinygltf::FsCallbacks{}));
  GltfModel model;
  std::string fault, warning;
  if (!reader.LoadASCIIFromString(&model.parts, &fault, &warning, text.data(), static_cast<unsigned>(text.size()),
                                  "")) {
    throw GltfError(fmt::format("tinygltf cannot parse it ({})", fault.substr(0, fault.find('\n'))));
  }
  exchange.give_back(model.parts);
  model.side_files = std::move(file.side_files);
  return model;
}

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

double number_or(const tinygltf::Value& object, const char* key, double missing) {
  return object.Has(key) ? object.Get(key).GetNumberAsDouble() : missing;
}

std::string text_or(const tinygltf::Value& object, const char* key, const char* missing) {
  return object.Has(key) ? object.Get(key).Get<std::string>() : missing;
}

}  // namespace afm::scene
