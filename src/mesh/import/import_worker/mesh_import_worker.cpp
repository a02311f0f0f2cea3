// Reads one mesh file for importMesh() in a separate process, so that a hostile file crashes
// only this process.
//   mesh_import_worker <memory, bytes> <seconds> <largest triangle count> <extension> <scale x> <y> <z>
// The file is open as descriptor 3, the answer goes to descriptor 4 (import_stream.h).
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <string_view>

#include "concave_distance/base/error.h"
#include "mesh/import/import_stream.h"
#include "process_limits.h"
#include "read_mesh.h"

namespace {

using namespace concave_distance;
using namespace concave_distance::detail;

struct Request {
  std::size_t memory;
  double seconds;
  std::uint64_t most_triangles;
  std::string extension;
  Eigen::Vector3d scale;
};

void writeAll(const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(kResultDescriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(EXIT_FAILURE);  // the reader is gone
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

void writeHeader(ImportStatus status, std::uint64_t first, std::uint64_t second) {
  ImportHeader header;
  header.status = status;
  header.first = first;
  header.second = second;
  writeAll(&header, sizeof header);
}

// Also where assimp would catch the exception and report another error.
void onOutOfMemory() {
  writeHeader(ImportStatus::OutOfMemory, 0, 0);
  _exit(EXIT_FAILURE);
}

std::string_view mapMeshFile() {
  struct stat status {};
  if (fstat(kMeshDescriptor, &status) != 0 || status.st_size <= 0) {
    throw Error("", "the file is empty", "export the mesh again");
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  const void* content = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, kMeshDescriptor, 0);
  if (content == MAP_FAILED) onOutOfMemory();
  return {static_cast<const char*>(content), size};
}

void answer(const Request& request) {
  try {
    const TriangleSoup soup =
        readMesh(mapMeshFile(), "", request.extension, request.scale, request.most_triangles);
    writeHeader(ImportStatus::Read, soup.vertices.size(), soup.triangles.size());
    writeAll(soup.vertices.data(), soup.vertices.size() * sizeof soup.vertices.front());
    writeAll(soup.triangles.data(), soup.triangles.size() * sizeof soup.triangles.front());
  } catch (const Error& error) {
    const std::string what = error.whatIsWrong().substr(0, kLongestImportText);
    const std::string remedy = error.remedy().substr(0, kLongestImportText);
    writeHeader(ImportStatus::Refused, what.size(), remedy.size());
    writeAll(what.data(), what.size());
    writeAll(remedy.data(), remedy.size());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 8) {
    std::fputs("This program is started by the package concave_distance to read a mesh file.\n", stderr);
    return 2;
  }
  const Request request{
      std::strtoull(argv[1], nullptr, 10),
      std::strtod(argv[2], nullptr),
      std::strtoull(argv[3], nullptr, 10),
      argv[4],
      {std::strtod(argv[5], nullptr), std::strtod(argv[6], nullptr), std::strtod(argv[7], nullptr)}};
  closeDescriptorsAbove(kResultDescriptor);
  limitProcess(request.memory, request.seconds);
  std::set_new_handler(onOutOfMemory);
  answer(request);
  _exit(EXIT_SUCCESS);  // without freeing memory, which takes a third of the time
}
