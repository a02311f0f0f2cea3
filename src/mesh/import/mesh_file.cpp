#include "mesh_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <utility>

#include "file_extension.h"

namespace concave_distance {
namespace {

// Closes its descriptor when an exception is thrown.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  int get() const { return descriptor_; }
  int release() { return std::exchange(descriptor_, -1); }

 private:
  int descriptor_;
};

[[noreturn]] void refuseToOpen(const std::string& path, int error) {
  if (error == ENOENT || error == ENOTDIR) {
    throw Error(path, "there is no such file", "check the path and the package it is in");
  }
  throw Error(path, std::string("the file cannot be opened: ") + std::strerror(error),
              "check its permissions and links");
}

std::string procPathOf(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

// Checks the opened file, not its path, where the file may be replaced at any time.
std::string realPathOf(int descriptor) {
  std::string real(PATH_MAX, '\0');
  const ssize_t size = readlink(procPathOf(descriptor).c_str(), real.data(), real.size());
  real.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return real;
}

void checkFolder(const std::string& path, int descriptor, const std::vector<std::string>& folders) {
  if (folders.empty()) return;
  const std::string real = realPathOf(descriptor);
  const bool allowed = std::any_of(folders.begin(), folders.end(),
                                   [&](const std::string& folder) { return isBelow(real, folder); });
  if (!allowed) throw outsideOfMeshFolders(path);
}

struct stat statusOf(const std::string& path, int descriptor) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) refuseToOpen(path, errno);
  return status;
}

bool readAt(int descriptor, std::uint64_t place, char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = pread(descriptor, data, size, static_cast<off_t>(place));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    data += count;
    place += static_cast<std::uint64_t>(count);
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

Error outsideOfMeshFolders(const std::string& name) {
  return {name, "services read no mesh from there",
          "name a file below one of the folders or packages that ~mesh_roots lists"};
}

bool isBelow(const std::string& path, const std::string& folder) {
  if (folder == "/") return !path.empty() && path.front() == '/';
  return path.compare(0, folder.size(), folder) == 0 &&
         (path.size() == folder.size() || path[folder.size()] == '/');
}

MeshFile::MeshFile(std::string path, const std::vector<std::string>& folders)
    : path_(std::move(path)), extension_(detail::lowerCaseExtension(path_)) {
  // O_PATH names the file without opening it, because opening a device or a FIFO has side effects.
  const Descriptor named(open(path_.c_str(), O_PATH | O_CLOEXEC));
  if (named.get() < 0) refuseToOpen(path_, errno);
  checkFolder(path_, named.get(), folders);
  if (!S_ISREG(statusOf(path_, named.get()).st_mode)) {
    throw Error(path_, "this is not a file, but a folder or a device", "name a mesh file");
  }
  Descriptor opened(open(procPathOf(named.get()).c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (opened.get() < 0) refuseToOpen(path_, errno);
  size_ = static_cast<std::uint64_t>(statusOf(path_, opened.get()).st_size);
  if (size_ == 0) throw Error(path_, "the file is empty", "export the mesh again");
  descriptor_ = opened.release();
}

MeshFile::MeshFile(MeshFile&& other) noexcept
    : path_(std::move(other.path_)),
      extension_(std::move(other.extension_)),
      size_(other.size_),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

MeshFile::~MeshFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool addMeshFile(ContentHasher& hasher, const MeshFile& file, const MeshImportLimits& limits) {
  if (file.size() > limits.memory) return false;
  constexpr std::size_t kBlock = std::size_t{1} << 24U;
  std::vector<char> block(static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, file.size())));
  hasher.add(file.extension()).add(file.size());
  for (std::uint64_t at = 0; at < file.size();) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), file.size() - at));
    if (!readAt(file.descriptor(), at, block.data(), wanted)) return false;
    hasher.addBytes(block.data(), wanted);
    at += wanted;
  }
  return true;
}

}  // namespace concave_distance
