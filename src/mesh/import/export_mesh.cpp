#include "concave_distance/mesh/import/export_mesh.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <ostream>

#include "base/output_file.h"
#include "concave_distance/base/error.h"
#include "file_extension.h"
#include "obj_text.h"

namespace concave_distance {
namespace {

void appendLittleEndian(std::string& bytes, std::uint64_t value, unsigned size) {
  for (unsigned i = 0; i < size; ++i) {
    bytes.push_back(static_cast<char>((value >> (8U * i)) & 0xffU));
  }
}

void appendVector(std::string& bytes, const Eigen::Vector3d& vector) {
  for (int k = 0; k < 3; ++k) {
    const auto value = static_cast<float>(vector[k]);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    appendLittleEndian(bytes, bits, 4);
  }
}

/// Binary: 80 bytes of header (not beginning with "solid"), a count, 50 bytes a triangle.
void writeStl(const SurfaceMesh& mesh, std::ostream& stream, const std::string& path) {
  std::string bytes = "binary STL, metres";
  bytes.resize(80, ' ');
  appendLittleEndian(bytes, mesh.triangleCount(), 4);
  bytes.reserve(84 + 50 * mesh.triangleCount());
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const Eigen::Vector3d& a = mesh.corner(triangle, 0);
    const Eigen::Vector3d& b = mesh.corner(triangle, 1);
    const Eigen::Vector3d& c = mesh.corner(triangle, 2);
    if (std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()}) >
        static_cast<double>(std::numeric_limits<float>::max())) {
      throw Error(path, "a coordinate exceeds what STL's single precision holds", "write OBJ or PLY");
    }
    appendVector(bytes, (b - a).cross(c - a).stableNormalized());
    appendVector(bytes, a);
    appendVector(bytes, b);
    appendVector(bytes, c);
    appendLittleEndian(bytes, 0, 2);
  }
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void writePly(const SurfaceMesh& mesh, std::ostream& stream) {
  stream << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertexCount()
         << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << mesh.triangleCount()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& v : mesh.vertices()) {
    stream << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  }
  for (const TriangleNodes& t : mesh.triangles()) {
    stream << "3 " << t[0].value << ' ' << t[1].value << ' ' << t[2].value << '\n';
  }
}

}  // namespace

void exportMesh(const SurfaceMesh& mesh, const std::string& path) {
  const std::string extension = detail::lowerCaseExtension(path);
  if (extension != ".stl" && extension != ".obj" && extension != ".ply") {
    throw Error(path, "the ending '" + extension + "' names no format that can be written",
                "end the file name in .stl, .obj or .ply");
  }
  OutputFile file(path);
  std::ostream& stream = file.stream();
  if (extension == ".stl") {
    writeStl(mesh, stream, path);
  } else if (extension == ".obj") {
    stream << detail::objText(mesh);
  } else {
    writePly(mesh, stream);
  }
  file.finish();
}

}  // namespace concave_distance
