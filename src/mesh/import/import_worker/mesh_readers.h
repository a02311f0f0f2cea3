#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "concave_distance/mesh/surface/surface_mesh.h"

// One reader for each format, chosen by readMesh().

namespace concave_distance::detail {

/// Reads binary or ASCII STL, three vertices a triangle, in the order of the file. A file is text when the
/// name line of its first solid is followed by a facet or an end; its words may be in capitals, facets may
/// have more than three corners, several solids may follow each other, and after the last one anything but a
/// facet. A binary file may be followed by padding, or by less than a facet.
/// @throws Error naming the file and the line or counts, when it breaks off or announces fewer facets than
///         follow
TriangleSoup readStl(std::string_view content, const std::string& path, std::uint64_t most_triangles);

/// Reads the vertices and faces of an OBJ file; names, groups, materials, normals, texture coordinates, lines
/// and points are passed over. A vertex of four numbers is homogeneous.
/// @throws Error naming the file and the line, also for curves and surfaces of free form, whose shape would
///         be lost, and as FileMesh::takeTriangles
TriangleSoup readObj(std::string_view content, const std::string& path, std::uint64_t most_triangles);

/// Reads a PLY file, text or binary of either byte order: vertices, faces and triangle strips, in any order
/// and with any properties. Other elements are passed over by what the header says about them.
/// @throws Error naming the file and the line or element, when the body has less or more than the header
///         announces, and as readPlyHeader and FileMesh::takeTriangles
TriangleSoup readPly(std::string_view content, const std::string& path, std::uint64_t most_triangles);

/// Reads every mesh of a COLLADA file by assimp, placed by the file's nodes, in metres by its <unit>, with
/// the axes of the file. A node that mirrors turns the winding. A hostile file may crash or hang this
/// process, or use all memory.
/// @throws Error naming the file, as plainDae and FileMesh::takeTriangles
TriangleSoup readDae(std::string_view content, const std::string& path, std::uint64_t most_triangles);

}  // namespace concave_distance::detail
