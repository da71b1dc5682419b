#include "scene/import/assimp_reader.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <set>

#include "core/file.hpp"
#include "scene/import/ac3d_text.hpp"
#include "scene/import/assimp_parts.hpp"
#include "scene/import/mesh_build.hpp"
#include "scene/import/mtl_text.hpp"

namespace lucerna::scene {
namespace {

constexpr std::size_t kMaxNodeDepth = 1000;
constexpr std::uint64_t kMaxLibraryBytes = 64ull << 20;

FileConventions conventionsOf(const std::string& extension) {
  FileConventions file;
  file.ac3d = extension == ".ac" || extension == ".acc";
  file.obj = extension == ".obj";
  return file;
}

mat4 toMat4(const aiMatrix4x4& m) {
  return mat4(m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4,
              m.c4, m.d4);
}

bool finite(const mat4& m) {
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(glm::value_ptr(m)[i])) return false;
  return true;
}

std::uint8_t unorm(float value) {
  return static_cast<std::uint8_t>(std::lround(255.f * std::clamp(value, 0.f, 1.f)));
}

// assimp's mesh with its vertex sharing, whatever that is. v = 0 is the bottom there, the top here.
Mesh looseMesh(const aiMesh& source) {
  Mesh mesh;
  mesh.name = source.mName.C_Str();
  const std::size_t count = source.mNumVertices;
  const auto* positions = reinterpret_cast<const vec3*>(source.mVertices);
  mesh.positions.assign(positions, positions + count);
  if (source.HasNormals()) {
    const auto* normals = reinterpret_cast<const vec3*>(source.mNormals);
    mesh.normals.assign(normals, normals + count);
  }
  for (unsigned set = 0; set < 2; ++set) {
    if (!source.HasTextureCoords(set)) continue;
    mesh.texCoords[set].reserve(count);
    for (std::size_t i = 0; i < count; ++i)
      mesh.texCoords[set].emplace_back(source.mTextureCoords[set][i].x,
                                       1.f - source.mTextureCoords[set][i].y);
  }
  if (source.HasVertexColors(0)) {
    mesh.colors.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const aiColor4D& c = source.mColors[0][i];
      mesh.colors.emplace_back(unorm(c.r), unorm(c.g), unorm(c.b), unorm(c.a));
    }
  }
  mesh.indices.reserve(3 * static_cast<std::size_t>(source.mNumFaces));
  for (unsigned f = 0; f < source.mNumFaces; ++f)
    if (source.mFaces[f].mNumIndices == 3)
      mesh.indices.insert(mesh.indices.end(), source.mFaces[f].mIndices,
                          source.mFaces[f].mIndices + 3);
  return mesh;
}

class Conversion {
 public:
  Conversion(const aiScene& source, const FileConventions& file)
      : source_(source), file_(file), materials_(convertMaterials(source, file, result_)) {}

  ImportedScene run(const mat4& metresFromFile) {
    convertMeshes();
    if (source_.mRootNode) addNodes(*source_.mRootNode, kNone, metresFromFile, 0);
    convertLights(source_, nodes_, result_.scene);
    const float unit = glm::length(vec3(metresFromFile[0]));  // m; attenuation is in file units
    for (Light& light : result_.scene.lights) light.attenuation /= vec3(1.f, unit, unit * unit);
    if (file_.lights) convertEdges(source_, nodes_, *file_.lights, result_.scene);
    convertCameras(source_, nodes_, result_.scene);
    convertAnimations(source_, nodes_, result_.scene);
    return std::move(result_);
  }

 private:
  void warn(std::string sentence) { result_.scene.warnings.push_back(std::move(sentence)); }

  void convertMeshes() {
    std::size_t dropped = 0, otherPrimitives = 0, skinned = 0;
    for (unsigned i = 0; i < source_.mNumMeshes; ++i) {
      const aiMesh& mesh = *source_.mMeshes[i];
      for (unsigned f = 0; f < mesh.mNumFaces; ++f)
        if (mesh.mFaces[f].mNumIndices != 3 && !(file_.lights && mesh.mFaces[f].mNumIndices == 2))
          ++otherPrimitives;
      if (mesh.HasBones()) ++skinned;
      result_.scene.meshes.push_back(buildMesh(looseMesh(mesh), dropped));
    }
    if (dropped > 0)
      warn(
          fmt::format("{} triangles have a corner that is not a number or does not exist; they "
                      "are left out",
                      dropped));
    if (otherPrimitives > 0)
      warn(
          fmt::format("{} points, lines or faces without area are left out; only triangles are "
                      "drawn",
                      otherPrimitives));
    if (skinned > 0)
      warn(fmt::format(
          "{} meshes have bones, which are not followed: they stand in their rest pose", skinned));
  }

  void addNodes(const aiNode& source, std::uint32_t parent, const mat4& above, std::size_t depth) {
    if (depth > kMaxNodeDepth)
      return warn(fmt::format("nodes below depth {} are left out", kMaxNodeDepth));
    Node node;
    node.name = source.mName.C_Str();
    node.parent = parent;
    mat4 local = above * toMat4(source.mTransformation);
    if (!finite(local)) {
      warn(
          fmt::format("node '{}': its matrix holds values that are not numbers; it stays where its "
                      "parent is",
                      node.name));
      local = mat4(1.f);
    }
    setLocalTransform(node, local);
    const std::uint32_t index = addNode(result_.scene, node);
    nodes_.emplace(node.name, index);
    for (unsigned i = 0; i < source.mNumMeshes; ++i) {
      const std::uint32_t mesh = source.mMeshes[i];
      if (result_.scene.meshes[mesh].indices.empty()) continue;
      Object object;
      object.node = index;
      object.mesh = mesh;
      const unsigned material = source_.mMeshes[mesh]->mMaterialIndex;
      object.material = material < materials_.size() ? materials_[material] : kNone;
      result_.scene.objects.push_back(object);
    }
    for (unsigned i = 0; i < source.mNumChildren; ++i)
      addNodes(*source.mChildren[i], index, mat4(1.f), depth + 1);
  }

  const aiScene& source_;
  const FileConventions& file_;
  ImportedScene result_;
  std::vector<std::uint32_t> materials_;
  NodesByName nodes_;
};

// FBX states its unit in centimetres and its up axis; assimp passes both on without using them.
mat4 metresFromFile(const aiScene& scene, const std::string& extension) {
  if (extension != ".fbx" || !scene.mMetaData) return mat4(1.f);
  mat4 result(1.f);
  double unit = 1.;
  float unitAsFloat = 1.f;
  if (scene.mMetaData->Get("UnitScaleFactor", unitAsFloat))
    unit = unitAsFloat;
  else
    scene.mMetaData->Get("UnitScaleFactor", unit);
  if (!(unit > 0.) || !std::isfinite(unit)) unit = 1.;
  int upAxis = 1;
  scene.mMetaData->Get("UpAxis", upAxis);
  if (upAxis == 2)  // z up
    result = glm::rotate(mat4(1.f), -glm::half_pi<float>(), vec3(1.f, 0.f, 0.f));
  return glm::scale(result, vec3(static_cast<float>(0.01 * unit)));
}

const aiScene* read(Assimp::Importer& importer, const std::filesystem::path& path,
                    const FileConventions& file) {
  // Nothing slow: we weld and make normals ourselves.
  constexpr unsigned kSteps = aiProcess_Triangulate;
  if (file.ac3d)
    if (const Result<std::string> text = readText(path, 1ull << 30)) {
      const std::string plain = plainAc3d(*text);
      return importer.ReadFileFromMemory(plain.data(), plain.size(), kSteps, "ac");
    }
  return importer.ReadFile(path.string(), kSteps);
}

std::string withoutFullStop(std::string sentence) {
  while (!sentence.empty() && (sentence.back() == '.' || sentence.back() == '\n'))
    sentence.pop_back();
  return sentence;
}

// The textured materials of a library are what their textures say, unless it gives a colour for
// them, too; assimp would multiply by a grey of its own.
void takeGreyOffTextures(const std::filesystem::path& library, Scene& scene) {
  const Result<Bytes> bytes = readFile(library, kMaxLibraryBytes);
  if (!bytes) return;
  const std::set<std::string> colored =
      materialsWithDiffuse({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  for (Material& material : scene.materials)
    if (material.albedoTexture.used() && !colored.contains(material.name))
      material.albedo = vec4(1.f, 1.f, 1.f, material.albedo.w);
}

// What assimp does not tell: a material library that is not there, and colours that are its own.
// Files name their libraries near the start.
void readLibraries(const std::filesystem::path& path, Scene& scene) {
  constexpr std::size_t kStart = 1 << 20;
  std::string text(kStart, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  bool namesLibrary = false;
  for (std::size_t at = 0; (at = text.find("mtllib ", at)) != text.npos;) {
    const bool startsLine = at == 0 || text[at - 1] == '\n';
    at += 7;
    if (!startsLine) continue;
    namesLibrary = true;
    std::string name = text.substr(at, text.find_first_of("\r\n", at) - at);
    while (!name.empty() && name.back() == ' ') name.pop_back();
    std::error_code code;
    std::filesystem::path standIn = path;
    standIn.replace_extension(".mtl");  // what assimp tries next
    const bool found = std::filesystem::exists(path.parent_path() / name, code);
    takeGreyOffTextures(found ? path.parent_path() / name : standIn, scene);
    if (found) continue;
    const std::string instead = std::filesystem::exists(standIn, code)
                                    ? standIn.filename().string() + " is read instead"
                                    : "its materials are a plain grey";
    scene.warnings.push_back(fmt::format("the material library '{}' is not beside {}; {}", name,
                                         path.filename().string(), instead));
  }
  if (!namesLibrary && text.find("\nusemtl ") != text.npos)
    scene.warnings.push_back(
        fmt::format("{} names materials but no library that holds them; they are a plain grey",
                    path.filename().string()));
}

}  // namespace

Result<ImportedScene> readWithAssimp(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  FileConventions file = conventionsOf(extension);
  std::optional<LightsIni> lights;
  if (file.obj) {
    LUCERNA_TRY(found, readLightsIni(path));
    lights = std::move(found);
    file.lights = lights ? &*lights : nullptr;
  }
  // Never freed: the worker ends after this file, and freeing a large scene takes longer than
  // reading it.
  static auto* importer = new Assimp::Importer;
  importer->SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene* scene = read(*importer, path, file);
  if (!scene)
    return error(ErrorKind::Input, "{}: {}; wanted a valid {} file; export it again", path.string(),
                 withoutFullStop(importer->GetErrorString()), extension);
  ImportedScene imported = Conversion(*scene, file).run(metresFromFile(*scene, extension));
  if (file.obj) readLibraries(path, imported.scene);
  return imported;
}

}  // namespace lucerna::scene
