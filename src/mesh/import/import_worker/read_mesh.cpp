#include "read_mesh.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/BaseImporter.h>
#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>
#include <vector>

#include "concave_distance/base/error.h"
#include "mesh_content_checks.h"
#include "one_file_system.h"

namespace concave_distance::detail {
namespace {

Eigen::Affine3d toEigen(const aiMatrix4x4& m) {
  Eigen::Matrix4d matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return Eigen::Affine3d(matrix);
}

/// Comes before assimp's later steps, which trust the indices of a file.
void checkMeshes(const aiScene& scene, const std::string& path) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    const std::string name = " of mesh '" + std::string(mesh.mName.C_Str()) + "'";
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        throw Error(path, "vertex " + std::to_string(v) + name + " has a coordinate that is not finite",
                    kExportAgain);
      }
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices) {
          throw Error(path,
                      "face " + std::to_string(f) + name + " refers to vertex " +
                          std::to_string(face.mIndices[k]) + " of " + std::to_string(mesh.mNumVertices),
                      kExportAgain);
        }
      }
    }
  }
}

/// Assimp keeps seven digits: a small body far from the file's origin would be distorted.
void checkPrecision(const aiScene& scene, const std::string& path) {
  constexpr double kRounding = 6e-8;  // of a coordinate, half a unit of single precision
  constexpr double kLargestShare = 0.01;
  double farthest = 0.0;
  double extent = 0.0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    Eigen::AlignedBox3d box;
    for (unsigned v = 0; v < scene.mMeshes[m]->mNumVertices; ++v) {
      const aiVector3D& p = scene.mMeshes[m]->mVertices[v];
      box.extend(Eigen::Vector3d(p.x, p.y, p.z));
    }
    if (box.isEmpty()) continue;
    farthest = std::max({farthest, box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()});
    extent = std::max(extent, box.diagonal().norm());
  }
  if (extent == 0.0 || kRounding * farthest <= kLargestShare * extent) return;
  std::ostringstream seen;
  seen << "the mesh is " << extent << " large, but has coordinates of " << farthest
       << "; with seven digits its shape is lost";
  throw Error(path, seen.str(), "move the mesh to the origin of its file and give the body a pose");
}

/// Sets the kinds of faces of each mesh. If a reader leaves them out or sets them wrong, assimp's
/// triangulation takes faces of fewer than three corners for polygons and aborts the process.
void statePrimitiveTypes(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    aiMesh& mesh = *scene.mMeshes[m];
    mesh.mPrimitiveTypes = 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const unsigned corners = mesh.mFaces[f].mNumIndices;
      mesh.mPrimitiveTypes |= static_cast<unsigned>(corners > 3    ? aiPrimitiveType_POLYGON
                                                    : corners == 3 ? aiPrimitiveType_TRIANGLE
                                                    : corners == 2 ? aiPrimitiveType_LINE
                                                                   : aiPrimitiveType_POINT);
    }
  }
}

void appendMesh(TriangleSoup& soup, const aiMesh& mesh, const Eigen::Affine3d& body_from_mesh,
                const std::string& path) {
  if (soup.vertices.size() + mesh.mNumVertices > 0xffffffffU) {
    throw Error(path, "the file has more than 2^32 vertices", "simplify the mesh");
  }
  const auto first = static_cast<std::uint32_t>(soup.vertices.size());
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    soup.vertices.emplace_back(body_from_mesh * Eigen::Vector3d(p.x, p.y, p.z));
    if (!soup.vertices.back().allFinite()) {
      throw Error(path, "a node's transform or the scale is too large or not a number", kExportAgain);
    }
  }
  const bool mirrored = body_from_mesh.linear().determinant() < 0.0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices == 3) {  // points and lines have no surface; polygons have been cut into triangles
      soup.triangles.push_back({first + face.mIndices[0], first + face.mIndices[mirrored ? 2 : 1],
                                first + face.mIndices[mirrored ? 1 : 2]});
    }
  }
}

void appendNode(TriangleSoup& soup, const aiScene& scene, const aiNode& node,
                const Eigen::Affine3d& body_from_node, const std::string& path) {
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    appendMesh(soup, *scene.mMeshes[node.mMeshes[i]], body_from_node, path);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    const aiNode& child = *node.mChildren[i];
    appendNode(soup, scene, child, body_from_node * toEigen(child.mTransformation), path);
  }
}

struct SoupSize {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
};

SoupSize operator+(const SoupSize& a, const SoupSize& b) {
  return {a.vertices + b.vertices, a.triangles + b.triangles};
}

SoupSize sizeOf(const aiMesh& mesh) {
  SoupSize size;
  size.vertices = mesh.mNumVertices;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) size.triangles += mesh.mFaces[f].mNumIndices == 3 ? 1U : 0U;
  return size;
}

/// Counts every instance. Stops beyond the limit, because a small file may refer to a mesh billions of times.
SoupSize sizeOf(const aiNode& node, const std::vector<SoupSize>& sizes, std::uint64_t most_triangles) {
  SoupSize size;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) size = size + sizes[node.mMeshes[i]];
  for (unsigned i = 0; i < node.mNumChildren && size.triangles <= most_triangles; ++i) {
    size = size + sizeOf(*node.mChildren[i], sizes, most_triangles);
  }
  return size;
}

SoupSize checkedSizeOf(const aiScene& scene, const std::string& path, std::uint64_t most_triangles) {
  std::vector<SoupSize> sizes;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) sizes.push_back(sizeOf(*scene.mMeshes[m]));
  const SoupSize size = sizeOf(*scene.mRootNode, sizes, most_triangles);
  if (size.triangles > most_triangles) {
    throw Error(path, "the file has more than " + std::to_string(most_triangles) + " triangles",
                "simplify the mesh, or raise the limit (of the node: ~limits/largest_triangle_count)");
  }
  if (size.triangles == 0) {
    throw Error(path, "the file has no triangle", "give a mesh with faces, not only points or lines");
  }
  return size;
}

/// Removes all readers from `importer` but that of the file's ending; otherwise the content chooses among
/// fifty.
/// @return the removed readers, which the caller owns
std::vector<std::unique_ptr<Assimp::BaseImporter>> keepOneReader(Assimp::Importer& importer,
                                                                 const std::string& extension) {
  const Assimp::BaseImporter* kept = importer.GetImporter(extension.c_str());
  std::vector<std::unique_ptr<Assimp::BaseImporter>> others;
  for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
    if (importer.GetImporter(i) != kept) others.emplace_back(importer.GetImporter(i));
  }
  for (const auto& other : others) importer.UnregisterLoader(other.get());
  return others;
}

TriangleSoup toSoup(const aiScene& scene, const std::string& path, bool collada, const Eigen::Vector3d& scale,
                    std::uint64_t most_triangles) {
  const SoupSize size = checkedSizeOf(scene, path, most_triangles);
  TriangleSoup soup;
  soup.vertices.reserve(size.vertices);
  soup.triangles.reserve(size.triangles);
  // For COLLADA the root's transform contains the <unit>. For other formats rviz ignores the root's transform
  // for all nodes below it.
  const aiNode& root = *scene.mRootNode;
  const Eigen::Affine3d body_from_file(Eigen::Scaling(scale));
  for (unsigned i = 0; i < root.mNumMeshes; ++i) {
    appendMesh(soup, *scene.mMeshes[root.mMeshes[i]], body_from_file * toEigen(root.mTransformation), path);
  }
  const Eigen::Affine3d body_from_root =
      collada ? Eigen::Affine3d(body_from_file * toEigen(root.mTransformation)) : body_from_file;
  for (unsigned i = 0; i < root.mNumChildren; ++i) {
    const aiNode& child = *root.mChildren[i];
    appendNode(soup, scene, child, body_from_root * toEigen(child.mTransformation), path);
  }
  return soup;
}

}  // namespace

TriangleSoup readMesh(std::string_view content, const std::string& path, const std::string& extension,
                      const Eigen::Vector3d& scale, std::uint64_t most_triangles) {
  checkMeshContent(content, path, extension, most_triangles);
  Assimp::Importer importer;
  const auto others = keepOneReader(importer, extension);
  // A fixed name, so that the file's own name has no influence.
  const std::string name = "mesh" + extension;
  importer.SetIOHandler(new OneFileSystem(name, content));  // the importer owns it
  // Assimp turns a COLLADA scene so that y points up, by the transform of the root node. rviz keeps the
  // file's axes for any <up_axis>, and so does this package.
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
  const aiScene* scene = importer.ReadFile(name, 0);
  if (scene != nullptr && scene->mRootNode != nullptr) {
    checkMeshes(*scene, path);
    checkPrecision(*scene, path);
    statePrimitiveTypes(*scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw Error(path, std::string("the file cannot be read as a mesh: ") + importer.GetErrorString(),
                "give a complete STL, OBJ, PLY or DAE file");
  }
  return toSoup(*scene, path, extension == ".dae", scale, most_triangles);
}

}  // namespace concave_distance::detail
