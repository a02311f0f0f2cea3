#include "import_process.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "base/number_text.h"
#include "child_process.h"
#include "concave_distance/base/error.h"
#include "import_stream.h"

namespace concave_distance::detail {
namespace {

constexpr double kLongestTime = 1e9;  // s, fits every clock
constexpr const char* kReinstall =
    "build and install the whole package, or set CONCAVE_DISTANCE_IMPORT_WORKER to the path of its "
    "mesh_import_worker";
constexpr const char* kExportAgain = "the file is broken: export the mesh again";

std::string exactText(double value) {
  return numberText(value, 17);
}

std::vector<std::string> argumentsOf(const MeshFile& file, const Eigen::Vector3d& scale,
                                     const MeshImportLimits& limits) {
  return {std::to_string(limits.memory),
          exactText(limits.seconds),
          std::to_string(limits.largest_triangle_count),
          file.extension(),
          exactText(scale.x()),
          exactText(scale.y()),
          exactText(scale.z())};
}

Error tooMuchMemory(const std::string& path, const MeshImportLimits& limits) {
  return {path, "reading it needs more than " + numberText(static_cast<double>(limits.memory) * 1e-6) + " MB",
          "simplify the mesh, or raise the limit (of the node: ~limits/import_memory_mb)"};
}

Error tooMuchTime(const std::string& path, const MeshImportLimits& limits) {
  return {path, "reading it takes more than " + numberText(limits.seconds) + " s",
          "simplify the mesh, or raise the limit (of the node: ~limits/import_seconds)"};
}

Error garbled(const std::string& path) {
  return {path, "the program that reads meshes gave an invalid answer", kReinstall};
}

/// Why the answer is incomplete.
Error describeEnd(const std::string& path, const std::string& worker, const ChildEnd& end,
                  const MeshImportLimits& limits) {
  if (end.was_stopped) return {path, "reading it was interrupted", "try again"};
  if (end.was_late || end.signal == SIGXCPU) return tooMuchTime(path, limits);
  if (!end.is_known) return {path, "the process that read it ended without an answer", kExportAgain};
  if (end.signal == SIGKILL) {
    return {path, "the system ended the process that read it, probably because memory is short",
            "free memory or simplify the mesh"};
  }
  if (end.signal == SIGINT || end.signal == SIGTERM || end.signal == SIGHUP) {
    return {path, "reading it was interrupted", "try again"};
  }
  if (end.signal != 0) {
    return {path,
            "the import library crashed on it (signal " + std::to_string(end.signal) + ", " +
                strsignal(end.signal) + ")",
            kExportAgain};
  }
  return {path, "'" + worker + "' ended with status " + std::to_string(end.exit_status) + " and no answer",
          kReinstall};
}

/// Memory is reserved only for sizes that the worker itself could have had.
bool isPlausible(const ImportHeader& header, const MeshImportLimits& limits) {
  if (header.magic != kImportMagic) return false;
  switch (header.status) {
    case ImportStatus::Read:
      return header.first <= limits.memory / sizeof(Eigen::Vector3d) && header.first <= 0xffffffffU &&
             header.second <= limits.largest_triangle_count;
    case ImportStatus::Refused:
      return header.first <= kLongestImportText && header.second <= kLongestImportText;
    case ImportStatus::OutOfMemory:
      return true;
  }
  return false;
}

bool readSoup(ChildProcess& worker, const ImportHeader& header, TriangleSoup& soup) {
  soup.vertices.resize(header.first);
  soup.triangles.resize(header.second);
  return worker.read(soup.vertices.data(), soup.vertices.size() * sizeof(Eigen::Vector3d)) &&
         worker.read(soup.triangles.data(), soup.triangles.size() * sizeof soup.triangles.front());
}

bool isValid(const TriangleSoup& soup) {
  const auto is_finite = [](const Eigen::Vector3d& vertex) { return vertex.allFinite(); };
  const auto in_range = [&](const std::array<std::uint32_t, 3>& corners) {
    return *std::max_element(corners.begin(), corners.end()) < soup.vertices.size();
  };
  return !soup.triangles.empty() && std::all_of(soup.vertices.begin(), soup.vertices.end(), is_finite) &&
         std::all_of(soup.triangles.begin(), soup.triangles.end(), in_range);
}

/// @throws Error with the message of the worker
bool readRefusal(ChildProcess& worker, const ImportHeader& header, const std::string& path) {
  std::string what(header.first, '\0');
  std::string remedy(header.second, '\0');
  if (!worker.read(what.data(), what.size()) || !worker.read(remedy.data(), remedy.size())) return false;
  throw Error(path, what, remedy);
}

}  // namespace

std::string importWorkerPath() {
  if (const char* named = std::getenv("CONCAVE_DISTANCE_IMPORT_WORKER"); named != nullptr && *named != '\0') {
    return named;
  }
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&importWorkerPath), &library) == 0) return "mesh_import_worker";
  // Below the library, or, where that is part of a program, beside the program, below the same prefix or
  // where it is installed.
  const std::filesystem::path folder = std::filesystem::absolute(library.dli_fname).parent_path();
  const std::filesystem::path below_the_library = folder / "concave_distance" / "mesh_import_worker";
  for (const std::filesystem::path& place :
       {below_the_library, folder / "mesh_import_worker",
        folder.parent_path() / "lib" / "concave_distance" / "mesh_import_worker",
        std::filesystem::path(CONCAVE_DISTANCE_INSTALLED_WORKER)}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(place, ignored)) return place.string();
  }
  return below_the_library.string();
}

TriangleSoup importInProcess(const std::string& worker_path, const MeshFile& file,
                             const Eigen::Vector3d& scale, const MeshImportLimits& wanted) {
  MeshImportLimits limits = wanted;
  limits.seconds = std::min(wanted.seconds, kLongestTime);
  if (file.size() > limits.memory) throw tooMuchMemory(file.path(), limits);
  try {
    ChildProcess worker(worker_path, argumentsOf(file, scale, limits), file.descriptor(), kMeshDescriptor,
                        kResultDescriptor, limits.seconds, limits.stop);
    ImportHeader header;
    TriangleSoup soup;
    if (!worker.read(&header, sizeof header))
      throw describeEnd(file.path(), worker_path, worker.end(), limits);
    if (!isPlausible(header, limits)) throw garbled(file.path());
    if (header.status == ImportStatus::OutOfMemory) throw tooMuchMemory(file.path(), limits);
    const bool whole = header.status == ImportStatus::Read ? readSoup(worker, header, soup)
                                                           : readRefusal(worker, header, file.path());
    if (!whole) throw describeEnd(file.path(), worker_path, worker.end(), limits);
    if (!isValid(soup)) throw garbled(file.path());
    return soup;
  } catch (const std::system_error& problem) {
    throw Error(file.path(),
                std::string("the program that reads meshes cannot be started: ") + problem.what(),
                kReinstall);
  }
}

}  // namespace concave_distance::detail
