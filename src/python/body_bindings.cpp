#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/triangle_measures.h"
#include "bindings.h"
#include "concave_distance/base/error.h"
#include "concave_distance/base/not_computed.h"
#include "concave_distance/loading/load_body_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "mesh/surface/surface_moments.h"
#include "pose_arrays.h"
#include "python_body.h"
#include "text.h"
#include "unlocked.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

constexpr double kChordErrorOfRadius = 0.01;

PythonBody loadBody(const std::string& path, double scale, std::optional<double> max_edge_length) {
  LoadMeshOptions options;
  options.body.max_edge_length = max_edge_length;
  LoadedBodyMesh loaded = loadBodyMesh(path, scale, options);
  return {std::move(loaded.mesh), loaded.repair};
}

TriangleSoup soupOf(const py::object& vertices, const py::object& triangles) {
  const DoubleArray points = readNumbers(vertices, "vertices");
  const DoubleArray corners = readNumbers(triangles, "triangles");
  if (points.ndim() != 2 || points.shape(1) != 3)
    throw Error("vertices", "is not an array of the shape (n, 3)", "give x, y, z of each vertex, metres");
  if (corners.ndim() != 2 || corners.shape(1) != 3)
    throw Error("triangles", "is not an array of the shape (m, 3)",
                "give three places in vertices for each triangle");
  TriangleSoup soup;
  for (py::ssize_t i = 0; i < points.shape(0); ++i)
    soup.vertices.emplace_back(points.at(i, 0), points.at(i, 1), points.at(i, 2));
  for (py::ssize_t i = 0; i < corners.shape(0); ++i) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double place = corners.at(i, static_cast<py::ssize_t>(k));
      if (!(place >= 0.0 && place < static_cast<double>(points.shape(0)) && place == std::floor(place)))
        throw Error("triangles", "row " + std::to_string(i) + " names a vertex that is not there",
                    "give places in vertices, from 0 to " + std::to_string(points.shape(0) - 1));
      triangle[k] = static_cast<std::uint32_t>(place);
    }
    soup.triangles.push_back(triangle);
  }
  return soup;
}

PythonBody makeBody(const py::object& vertices, const py::object& triangles, const std::string& name,
                    double weld_tolerance, bool orient) {
  const TriangleSoup soup = soupOf(vertices, triangles);
  const Unlocked unlocked;
  RepairOptions options;
  options.weld_tolerance = weld_tolerance;
  options.orient = orient;
  RepairedMesh repaired = repairMesh(soup, options, name);
  return {std::make_shared<const BodyMesh>(name, std::move(repaired.mesh)), repaired.report};
}

RepairReport closedReport(const SurfaceMesh& mesh) {
  RepairReport report;
  report.vertices_in = mesh.vertexCount();
  report.triangles_in = mesh.triangleCount();
  report.shells = report.closed_shells = 1;
  return report;
}

PythonBody boxOf(const std::array<double, 3>& size, const std::string& name) {
  SurfaceMesh mesh = makeBox({size[0], size[1], size[2]}, name);
  const RepairReport report = closedReport(mesh);
  return {std::make_shared<const BodyMesh>(name, std::move(mesh)), report};
}

PythonBody roundBody(RoundKind kind, double radius, double length, std::optional<double> chord_error,
                     const std::string& name) {
  RoundShape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = 0.5 * length;
  shape.chord_error = chord_error.value_or(kChordErrorOfRadius * radius);
  SurfaceMesh mesh = inscribedMesh(shape, name);
  const RepairReport report = closedReport(mesh);
  BodyMeshOptions options;
  options.shape = shape;
  return {std::make_shared<const BodyMesh>(name, std::move(mesh), options), report};
}

double areaOf(const PythonBody& body) {
  const SurfaceMesh& mesh = body.mesh->surface();
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    area += triangleArea(mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2));
  }
  return area;
}

double volumeOfBody(const PythonBody& body) {
  if (body.mesh->shape() != nullptr) return volumeOf(*body.mesh->shape());
  if (body.repair.closed_shells != body.repair.shells) return kNotComputed;
  return detail::SurfaceMoments(body.mesh->surface()).volume;
}

py::array_t<double> verticesOf(const PythonBody& body) {
  const auto& vertices = body.mesh->surface().vertices();
  py::array_t<double> array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(vertices.size()), 3});
  double* at = array.mutable_data();
  for (const Eigen::Vector3d& vertex : vertices) {
    for (int axis = 0; axis < 3; ++axis) *at++ = vertex[axis];
  }
  return array;
}

py::array_t<std::uint32_t> trianglesOf(const PythonBody& body) {
  const auto& triangles = body.mesh->surface().triangles();
  py::array_t<std::uint32_t> array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(triangles.size()), 3});
  std::uint32_t* at = array.mutable_data();
  for (const TriangleNodes& triangle : triangles) {
    for (const NodeIndex corner : triangle) *at++ = corner.value;
  }
  return array;
}

void bindReport(py::module& module) {
  const auto count = [](auto member) {
    return [member](const RepairReport& report) { return report.*member; };
  };
  py::class_<RepairReport>(module, "RepairReport",
                           "What was found and changed when a mesh was repaired; counts.")
      .def_property_readonly("vertices_in", count(&RepairReport::vertices_in))
      .def_property_readonly("triangles_in", count(&RepairReport::triangles_in))
      .def_property_readonly("welded_vertices", count(&RepairReport::welded_vertices))
      .def_property_readonly("largest_move", count(&RepairReport::largest_move),
                             "Of a vertex by welding, metres.")
      .def_property_readonly("zero_area_triangles", count(&RepairReport::zero_area_triangles), "Dropped.")
      .def_property_readonly("duplicate_triangles", count(&RepairReport::duplicate_triangles), "Dropped.")
      .def_property_readonly("inner_wall_triangles", count(&RepairReport::inner_wall_triangles), "Dropped.")
      .def_property_readonly("turned_triangles", count(&RepairReport::turned_triangles))
      .def_property_readonly("shells", count(&RepairReport::shells), "Of the result, as the rest.")
      .def_property_readonly("closed_shells", count(&RepairReport::closed_shells))
      .def_property_readonly("holes", count(&RepairReport::holes))
      .def_property_readonly("border_edges", count(&RepairReport::border_edges))
      .def_property_readonly("non_manifold_edges", count(&RepairReport::non_manifold_edges))
      .def("__str__", [](const RepairReport& report) {
        const std::string summary = report.summary();
        return toPython(summary.empty() ? "nothing to repair" : summary);
      });
}

}  // namespace

void bindBodies(py::module& module) {
  bindReport(module);
  py::class_<PythonBody>(
      module, "BodyMesh",
      "A body, ready for queries: immutable, may be shared by pairs and threads. Its own frame, "
      "metres.")
      .def_property_readonly("name", [](const PythonBody& body) { return toPython(body.mesh->name()); })
      .def_property_readonly("vertices", &verticesOf, "(n, 3) metres, of the repaired surface.")
      .def_property_readonly("triangles", &trianglesOf, "(m, 3) uint32, places in vertices.")
      .def_property_readonly("area", &areaOf, "Of the triangles, m^2.")
      .def_property_readonly("volume", &volumeOfBody, "m^3; NaN for a surface that is not closed.")
      .def_property_readonly(
          "diameter", [](const PythonBody& body) { return body.mesh->diameter(); },
          "Diagonal of the bounding box, metres.")
      .def_property_readonly(
          "shells", [](const PythonBody& body) { return body.repair.shells; },
          "Number of connected surfaces.")
      .def_readonly("repair", &PythonBody::repair, "RepairReport of loading it.");
  module.def("load_body", &loadBody, py::arg("path"), py::arg("scale") = 1.0,
             py::arg("max_edge_length") = py::none(), py::call_guard<Unlocked>(),
             "Reads a mesh file (.stl, .obj, .ply, .dae), repairs it and makes it ready for queries.\n\n"
             "scale: factor on the file's coordinates, 0.001 for millimetres\n"
             "max_edge_length: of the search's grid, metres; None: automatic\n"
             "Raises Error naming the file.");
  module.def("make_body", &makeBody, py::arg("vertices"), py::arg("triangles"), py::arg("name") = "body",
             py::arg("weld_tolerance") = kSinglePrecisionWeld, py::arg("orient") = true,
             "Repairs triangles and makes a body of them.\n\n"
             "vertices: (n, 3) metres; triangles: (m, 3) places in vertices\n"
             "weld_tolerance: border vertices this near become one, a share of the bounding box's diagonal\n"
             "orient: turn triangles so that neighbours agree and closed shells face outwards\n"
             "Raises Error when nothing with an area is left.");
  module.def("make_box", &boxOf, py::arg("size"), py::arg("name") = "box",
             "A box around the origin. size: (3,) metres. Raises Error for sizes that are not positive.");
  module.def(
      "make_sphere",
      [](double radius, const std::string& name, std::optional<double> chord_error) {
        return roundBody(RoundKind::Sphere, radius, 0.0, chord_error, name);
      },
      py::arg("radius"), py::arg("name") = "sphere", py::arg("chord_error") = py::none(),
      "A sphere around the origin, exact. radius: metres; chord_error: of the mesh that is searched and "
      "drawn, "
      "metres, None: 1 % of the radius.");
  module.def(
      "make_cylinder",
      [](double radius, double length, const std::string& name, std::optional<double> chord_error) {
        return roundBody(RoundKind::Cylinder, radius, length, chord_error, name);
      },
      py::arg("radius"), py::arg("length"), py::arg("name") = "cylinder", py::arg("chord_error") = py::none(),
      "A cylinder along z around the origin, exact. Metres; chord_error as of make_sphere.");
  module.def(
      "make_capsule",
      [](double radius, double length, const std::string& name, std::optional<double> chord_error) {
        return roundBody(RoundKind::Capsule, radius, length, chord_error, name);
      },
      py::arg("radius"), py::arg("length"), py::arg("name") = "capsule", py::arg("chord_error") = py::none(),
      "A capsule along z around the origin, exact; length is that of the cylindrical part. Metres; "
      "chord_error as "
      "of make_sphere.");
}

}  // namespace concave_distance::python
