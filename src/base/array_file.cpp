#include "array_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace concave_distance {
namespace {

// Read back in another order of bytes it is another number.
constexpr std::uint32_t kByteOrder = 0x01020304U;

struct Head {
  char magic[8];
  std::uint32_t format;
  std::uint32_t byte_order;
  ContentKey key;
  std::uint64_t size;  ///< of the whole file, bytes
};
static_assert(sizeof(Head) == 40, "no padding, the same on every machine");

struct ArrayHead {
  std::uint64_t element_size;
  std::uint64_t count;
};

Head headOf(const ContentKey& key, std::uint64_t size) {
  return {{'c', 'o', 'n', 'c', 'd', 'i', 's', 't'}, array_file::kFormat, kByteOrder, key, size};
}

ContentKey checksumOf(const ArrayHead& head, const void* data) {
  return ContentHasher()
      .add(head.element_size)
      .add(head.count)
      .addBytes(data, head.element_size * head.count)
      .key();
}

/// One for every writer of every process.
std::string temporaryName(const std::string& path) {
  static std::atomic<std::uint32_t> writers{0};
  return path + '.' + std::to_string(::getpid()) + '.' + std::to_string(writers++) + ".tmp";
}

}  // namespace

ArrayFileWriter::ArrayFileWriter(std::string path, const ContentKey& key)
    : path_(std::move(path)), temporary_path_(temporaryName(path_)), key_(key) {
  file_.open(temporary_path_, std::ios::binary | std::ios::trunc);
  const Head head = headOf(key_, 0);  // the size is not known yet
  file_.write(reinterpret_cast<const char*>(&head), sizeof(head));
  size_ = sizeof(head);
  if (!file_) fail("write");
}

ArrayFileWriter::~ArrayFileWriter() {
  if (temporary_path_.empty()) return;
  file_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_path_, ignored);
}

void ArrayFileWriter::fail(const char* doing) {
  if (!problem_.empty()) return;
  problem_ = std::string("cannot ") + doing + " " + path_;
  if (errno != 0) problem_ += std::string(": ") + std::strerror(errno);
}

void ArrayFileWriter::bytes(const void* data, std::size_t element_size, std::size_t count) {
  if (!problem_.empty()) return;
  const ArrayHead head{element_size, count};
  const ContentKey checksum = checksumOf(head, data);
  file_.write(reinterpret_cast<const char*>(&head), sizeof(head));
  file_.write(static_cast<const char*>(data), static_cast<std::streamsize>(element_size * count));
  file_.write(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
  size_ += sizeof(head) + element_size * count + sizeof(checksum);
  if (!file_) fail("write");
}

bool ArrayFileWriter::finish() {
  if (!problem_.empty()) return false;
  const Head head = headOf(key_, size_);
  file_.seekp(0);
  file_.write(reinterpret_cast<const char*>(&head), sizeof(head));
  file_.close();
  if (!file_) {
    fail("write");
    return false;
  }
  std::error_code error;
  std::filesystem::rename(temporary_path_, path_, error);
  if (error) {
    errno = error.value();
    fail("put in place");
    return false;
  }
  temporary_path_.clear();
  return true;
}

ArrayFileReader::ArrayFileReader(const std::string& path, const ContentKey& key) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size < sizeof(Head)) return;
  file_.rdbuf()->pubsetbuf(nullptr, 0);  // arrays are read whole
  file_.open(path, std::ios::binary);
  left_ = size;
  ok_ = true;
  Head head{};
  const Head expected = headOf(key, size);
  ok_ = read(&head, sizeof(head)) && std::memcmp(&head, &expected, sizeof(head)) == 0;
}

bool ArrayFileReader::read(void* data, std::size_t size) {
  if (!ok_ || size > left_) return false;
  file_.read(static_cast<char*>(data), static_cast<std::streamsize>(size));
  left_ -= size;
  return static_cast<bool>(file_);
}

std::size_t ArrayFileReader::beginArray(std::size_t element_size) {
  ArrayHead head{};
  // Before memory is asked for: a count that the file cannot hold is none of ours.
  ok_ = read(&head, sizeof(head)) && head.element_size == element_size && head.count <= left_ / element_size;
  return ok_ ? head.count : 0;
}

void ArrayFileReader::readArray(void* data, std::size_t element_size, std::size_t count) {
  ContentKey checksum;
  ok_ = read(data, element_size * count) && read(&checksum, sizeof(checksum)) &&
        checksum == checksumOf({element_size, count}, data);
}

}  // namespace concave_distance
