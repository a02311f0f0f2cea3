#include "mesh_readers.h"

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "concave_distance/base/error.h"
#include "dae_text.h"
#include "file_mesh.h"
#include "text_words.h"

namespace concave_distance::detail {
namespace {

/// The only file that assimp sees, from memory; no material libraries, textures or archives.
class OneFileSystem : public Assimp::IOSystem {
 public:
  OneFileSystem(std::string name, std::string_view content) : name_(std::move(name)), content_(content) {}

  bool Exists(const char* file) const override { return name_ == file; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (name_ != file || mode[0] != 'r') return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(content_.data()),
                                      content_.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  std::string_view content_;
};

Eigen::Affine3d toEigen(const aiMatrix4x4& m) {
  Eigen::Matrix4d matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return Eigen::Affine3d(matrix);
}

FileMesh toFileMesh(const aiMesh& mesh) {
  FileMesh converted({"face", " of mesh " + inQuotes(mesh.mName.C_Str())});
  converted.vertices().reserve(mesh.mNumVertices);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    converted.vertices().emplace_back(p.x, p.y, p.z);
  }
  std::vector<std::int64_t> corners;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    corners.assign(face.mIndices, face.mIndices + face.mNumIndices);
    converted.addFace(corners, f);
  }
  return converted;
}

std::vector<TriangleSoup> toSoups(const aiScene& scene, const std::string& path,
                                  std::uint64_t most_triangles) {
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<TriangleSoup> soups;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    soups.push_back(toFileMesh(*scene.mMeshes[m]).takeTriangles(path, most_triangles));
    boxes.push_back(boxOf(soups.back().vertices));
  }
  // Assimp keeps seven digits.
  checkSinglePrecision(boxes, path);
  return soups;
}

/// Counts what a file unfolds to, with every instance of a mesh.
struct SoupSize {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
};

/// Stops beyond the limit, because a small file may refer to a mesh billions of times.
void addSize(SoupSize& size, const aiNode& node, const std::vector<TriangleSoup>& soups,
             std::uint64_t most_triangles) {
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    size.vertices += soups[node.mMeshes[i]].vertices.size();
    size.triangles += soups[node.mMeshes[i]].triangles.size();
  }
  for (unsigned i = 0; i < node.mNumChildren && size.triangles <= most_triangles; ++i) {
    addSize(size, *node.mChildren[i], soups, most_triangles);
  }
}

void appendMesh(TriangleSoup& body, const TriangleSoup& mesh, const Eigen::Affine3d& body_from_mesh,
                const std::string& path) {
  const auto first = static_cast<std::uint32_t>(body.vertices.size());
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    body.vertices.emplace_back(body_from_mesh * vertex);
    if (!body.vertices.back().allFinite()) {
      throw Error(path, "a node's transform is too large or not a number", kExportAgain);
    }
  }
  const bool mirrored = body_from_mesh.linear().determinant() < 0.0;
  for (const auto& corners : mesh.triangles) {
    body.triangles.push_back(
        {first + corners[0], first + corners[mirrored ? 2 : 1], first + corners[mirrored ? 1 : 2]});
  }
}

void appendNode(TriangleSoup& body, const std::vector<TriangleSoup>& soups, const aiNode& node,
                const Eigen::Affine3d& body_from_parent, const std::string& path) {
  // The root's transform contains the <unit>.
  const Eigen::Affine3d body_from_node = body_from_parent * toEigen(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    appendMesh(body, soups[node.mMeshes[i]], body_from_node, path);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    appendNode(body, soups, *node.mChildren[i], body_from_node, path);
  }
}

/// Removes all readers from `importer` but COLLADA's; otherwise the content chooses among fifty.
/// @return the removed readers, which the caller owns
std::vector<std::unique_ptr<Assimp::BaseImporter>> keepColladaReader(Assimp::Importer& importer) {
  const Assimp::BaseImporter* kept = importer.GetImporter(".dae");
  std::vector<std::unique_ptr<Assimp::BaseImporter>> others;
  for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
    if (importer.GetImporter(i) != kept) others.emplace_back(importer.GetImporter(i));
  }
  for (const auto& other : others) importer.UnregisterLoader(other.get());
  return others;
}

}  // namespace

TriangleSoup readDae(std::string_view content, const std::string& path, std::uint64_t most_triangles) {
  const std::string text = plainDae(content, path);
  Assimp::Importer importer;
  const auto others = keepColladaReader(importer);
  // A fixed name, so that the file's own name has no influence.
  const std::string name = "mesh.dae";
  importer.SetIOHandler(new OneFileSystem(name, text));  // the importer owns it
  // Assimp turns the scene so that y points up, by the transform of the root node. rviz keeps the file's axes
  // for any <up_axis>, and so does this package.
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
  const aiScene* scene = importer.ReadFile(name, 0);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw Error(path, std::string("the file cannot be read as a mesh: ") + importer.GetErrorString(),
                "give a complete STL, OBJ, PLY or DAE file");
  }
  const std::vector<TriangleSoup> soups = toSoups(*scene, path, most_triangles);
  SoupSize size;
  addSize(size, *scene->mRootNode, soups, most_triangles);
  checkTriangleCount(size.triangles, most_triangles, path);
  if (size.vertices > 0xffffffffU)
    throw Error(path, "the file has more than 2^32 vertices", "simplify the mesh");
  TriangleSoup body;
  body.vertices.reserve(size.vertices);
  body.triangles.reserve(size.triangles);
  appendNode(body, soups, *scene->mRootNode, Eigen::Affine3d::Identity(), path);
  return body;
}

}  // namespace concave_distance::detail
