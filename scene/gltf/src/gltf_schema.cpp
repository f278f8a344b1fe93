// SPDX-License-Identifier: Apache-2.0
#include "gltf_schema.h"

#include "gltf_material_extensions.h"
#include "gltf_members.h"

// Tables in the order of section 5 of the glTF 2.0 specification, each before the one that contains it. The ranges are
// those of the specification, or wide but safe from overflow in float.
namespace afm::scene {
namespace {

using namespace gltf_member;
using Kind = GltfMember::Kind;

constexpr double kBytes = static_cast<double>(kLargestGltfBytes);
constexpr double kRightAngle = 1.5707963267948966;

constexpr GltfMember kAsset[]{text("version").required(), text("minVersion"), text("generator"), text("copyright")};
constexpr GltfMember kHeader[]{object("asset", kAsset).required(), text("extensionsUsed").list(0, kMostMaterials),
                               text("extensionsRequired").list(0, kMostMaterials)};

// Empty parts that nothing uses are common; the users of a view, an accessor or a skin check that it is not empty. An
// accessor without a view is all zeros, so that a small file can require much memory
constexpr GltfMember kCount = whole("count", 0, 24'000'000).by_our_limit().required();
constexpr GltfMember kView = index("bufferView", GltfList::BufferViews);
constexpr GltfMember kOffset = whole("byteOffset", 0, kBytes).by_our_limit();
constexpr GltfMember kLength = whole("byteLength", 0, kBytes).by_our_limit().required();
constexpr GltfMember kSparseIndices[]{kView.required(), kOffset, choice("componentType", "5121 5123 5125").required()};
constexpr GltfMember kSparseValues[]{kView.required(), kOffset};
constexpr GltfMember kSparse[]{kCount, object("indices", kSparseIndices).required(),
                               object("values", kSparseValues).required()};
constexpr GltfMember kAccessor[]{kView,
                                 kOffset.with("bufferView"),
                                 choice("componentType", "5120 5121 5122 5123 5125 5126").required(),
                                 flag("normalized"),
                                 kCount,
                                 choice("type", "SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4").required(),
                                 number("max", -1e300, 1e300).list(0, 16),
                                 number("min", -1e300, 1e300).list(0, 16),
                                 object("sparse", kSparse),
                                 text("name")};

constexpr GltfMember kTarget[]{index("node", GltfList::Nodes), text("path").required()};
constexpr GltfMember kChannel[]{whole("sampler", 0, 4e6).required(), object("target", kTarget).required()};
constexpr GltfMember kAnimationSampler[]{index("input", GltfList::Accessors).required(),
                                         choice("interpolation", "LINEAR STEP CUBICSPLINE"),
                                         index("output", GltfList::Accessors).required()};
constexpr GltfMember kAnimation[]{object("channels", kChannel).list(0, kMany).required(),
                                  object("samplers", kAnimationSampler).list(0, kMany).required(), text("name")};

constexpr GltfMember kBuffer[]{text("uri"), kLength, text("name")};
constexpr GltfMember kMeshopt[]{index("buffer", GltfList::Buffers).required(),
                                kOffset,
                                kLength,
                                whole("byteStride", 1, 256).required(),
                                whole("count", 0, kBytes).by_our_limit().required(),
                                choice("mode", "ATTRIBUTES TRIANGLES INDICES").required(),
                                choice("filter", "NONE OCTAHEDRAL QUATERNION EXPONENTIAL")};
constexpr GltfMember kBufferViewExtensions[]{object("EXT_meshopt_compression", kMeshopt)};
constexpr GltfMember kBufferView[]{index("buffer", GltfList::Buffers).required(),
                                   kOffset,
                                   kLength,
                                   whole("byteStride", 4, 252),
                                   choice("target", "34962 34963"),
                                   text("name"),
                                   object("extensions", kBufferViewExtensions)};

constexpr GltfMember kOrthographic[]{above_zero("xmag").required(), above_zero("ymag").required(),
                                     above_zero("zfar").required(), positive("znear").required()};
constexpr GltfMember kPerspective[]{above_zero("aspectRatio"), number("yfov", 1e-6, 3.1415).required(),
                                    above_zero("zfar"), above_zero("znear").required()};
constexpr GltfMember kCamera[]{object("orthographic", kOrthographic).without("perspective"),
                               object("perspective", kPerspective),
                               choice("type", "perspective orthographic").required(), text("name")};

constexpr GltfMember kImage[]{text("uri").without("bufferView"), text("mimeType"), kView, text("name")};

constexpr GltfMember kMetallicRoughness[]{share("baseColorFactor").list(4, 4), texture("baseColorTexture"),
                                          share("metallicFactor"), share("roughnessFactor"),
                                          texture("metallicRoughnessTexture")};
constexpr GltfMember kDraco[]{kView.required(), GltfMember{"attributes", Kind::Numbers, 0, 65535}.required()};
constexpr GltfMember kMapping[]{index("material", GltfList::Materials).required(),
                                index("variants", GltfList::Variants).list(0, kMany).required(), text("name")};
constexpr GltfMember kMappings[]{object("mappings", kMapping).list(0, kMany).required()};
constexpr GltfMember kPrimitiveExtensions[]{object("KHR_draco_mesh_compression", kDraco),
                                            object("KHR_materials_variants", kMappings)};
constexpr GltfMember kPrimitive[]{accessors("attributes").required(),     index("indices", GltfList::Accessors),
                                  index("material", GltfList::Materials), whole("mode", 0, 6),
                                  accessors("targets").list(0, kMany),    object("extensions", kPrimitiveExtensions)};
constexpr GltfMember kMesh[]{object("primitives", kPrimitive).list(0, kMany).required(),
                             number("weights").list(0, kMany), text("name")};

constexpr GltfMember kInstancing[]{accessors("attributes").required()};
constexpr GltfMember kNodeLight[]{index("light", GltfList::Lights).required()};
constexpr GltfMember kNodeExtensions[]{object("EXT_mesh_gpu_instancing", kInstancing),
                                       object("KHR_lights_punctual", kNodeLight)};
constexpr GltfMember kNode[]{index("camera", GltfList::Cameras),
                             index("children", GltfList::Nodes).list(0, kMany),
                             index("skin", GltfList::Skins).with("mesh"),
                             number("matrix").list(16, 16).without("translation rotation scale"),
                             index("mesh", GltfList::Meshes),
                             number("rotation", -1.01, 1.01).list(4, 4),
                             number("scale").list(3, 3),
                             number("translation").list(3, 3),
                             number("weights").list(0, kMany),
                             text("name"),
                             object("extensions", kNodeExtensions)};

constexpr GltfMember kSampler[]{choice("magFilter", "9728 9729"), choice("minFilter", "9728 9729 9984 9985 9986 9987"),
                                choice("wrapS", "33071 33648 10497"), choice("wrapT", "33071 33648 10497"),
                                text("name")};
constexpr GltfMember kScene[]{index("nodes", GltfList::Nodes).list(0, kMany), text("name")};
constexpr GltfMember kSkin[]{index("inverseBindMatrices", GltfList::Accessors), index("skeleton", GltfList::Nodes),
                             index("joints", GltfList::Nodes).list(0, kMany).required(), text("name")};
constexpr GltfMember kTexture[]{index("sampler", GltfList::Samplers), index("source", GltfList::Images), text("name")};

constexpr GltfMember kSpot[]{number("innerConeAngle", 0, kRightAngle).rounded(kRounding),
                             number("outerConeAngle", 0, kRightAngle).rounded(kRounding)};
constexpr GltfMember kLight[]{text("name"),
                              positive("color", 1e6).list(3, 3),
                              positive("intensity", 1e12),
                              choice("type", "directional point spot").required(),
                              above_zero("range"),
                              object("spot", kSpot)};
constexpr GltfMember kLights[]{object("lights", kLight).list(0, kMany).required()};
constexpr GltfMember kVariant[]{text("name").required()};
constexpr GltfMember kVariants[]{object("variants", kVariant).list(0, kMany).required()};
constexpr GltfMember kRootExtensions[]{object("KHR_lights_punctual", kLights),
                                       object("KHR_materials_variants", kVariants)};

void collect_extensions(std::span<const GltfMember> members, std::set<std::string_view>& names) {
  for (const GltfMember& member : members) {
    if (member.name == "extensions") {
      for (const GltfMember& extension : member.members) names.insert(extension.name);
    }
    collect_extensions(member.members, names);
  }
}

}  // namespace

std::span<const GltfMember> gltf_header() { return kHeader; }
std::span<const GltfMember> gltf_document() {
  static const GltfMember kMaterial[]{text("name"),
                                      object("extensions", gltf_material_extension_members()),
                                      object("pbrMetallicRoughness", kMetallicRoughness),
                                      object("normalTexture", kNormalTexture),
                                      object("occlusionTexture", kOcclusionTexture),
                                      texture("emissiveTexture"),
                                      share("emissiveFactor").clamped_above().list(3, 3),
                                      choice("alphaMode", "OPAQUE MASK BLEND"),
                                      positive("alphaCutoff"),
                                      flag("doubleSided")};
  static const GltfMember kDocument[]{object("buffers", kBuffer).list(0, kMany),
                                      object("bufferViews", kBufferView).list(0, kMany),
                                      object("accessors", kAccessor).list(0, kMany),
                                      object("animations", kAnimation).list(0, kMany),
                                      object("cameras", kCamera).list(0, kMany),
                                      object("images", kImage).list(0, kMostMaterials),
                                      object("samplers", kSampler).list(0, kMostMaterials),
                                      object("textures", kTexture).list(0, kMostMaterials),
                                      object("materials", kMaterial).list(0, kMostMaterials),
                                      object("meshes", kMesh).list(0, kMany),
                                      object("nodes", kNode).list(0, kMany),
                                      index("scene", GltfList::Scenes),
                                      object("scenes", kScene).list(0, kMany),
                                      object("skins", kSkin).list(0, kMany),
                                      object("extensions", kRootExtensions)};
  return kDocument;
}

std::set<std::string_view> gltf_extensions() {
  std::set<std::string_view> names{"KHR_mesh_quantization"};  // extension without an object; it allows more types
  collect_extensions(gltf_document(), names);
  return names;
}

}  // namespace afm::scene
