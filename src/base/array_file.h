#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <type_traits>
#include <vector>

#include "content_hash.h"

namespace concave_distance {

/// Says which types may be stored as their bytes. It is specialised for types that are plain data though
/// their copying is not trivial in the language's sense.
template <typename T>
struct IsPlainData : std::is_trivially_copyable<T> {};
template <typename Scalar, int kRows, int kColumns>
struct IsPlainData<Eigen::Matrix<Scalar, kRows, kColumns>>
    : std::bool_constant<(kRows > 0 && kColumns > 0 && std::is_arithmetic_v<Scalar>)> {};

/// A file of arrays as they lie in memory. Its head says what wrote it (format, byte order), what it holds
/// (the key) and how long it is; every array has its element's size, its count and a checksum. Every byte is
/// covered by one of these checks.
namespace array_file {
/// Raised when the layout of the file changes.
inline constexpr std::uint32_t kFormat = 1;
}  // namespace array_file

/// Writes to a file of another name in the same folder and renames it when all is there: whoever reads meets
/// a whole file or none. Never throws.
class ArrayFileWriter {
 public:
  ArrayFileWriter(std::string path, const ContentKey& key);
  ~ArrayFileWriter();  ///< takes back what was not finished
  ArrayFileWriter(const ArrayFileWriter&) = delete;
  ArrayFileWriter& operator=(const ArrayFileWriter&) = delete;

  template <typename T>
  void array(const std::vector<T>& values) {
    static_assert(IsPlainData<T>::value, "an array of plain data");
    bytes(values.data(), sizeof(T), values.size());
  }
  template <typename T>
  void value(const T& value) {
    static_assert(IsPlainData<T>::value, "plain data");
    bytes(&value, sizeof(T), 1);
  }
  /// True when the file is in its place.
  bool finish();
  /// Returns what went wrong; empty while nothing has.
  const std::string& problem() const { return problem_; }

 private:
  void bytes(const void* data, std::size_t element_size, std::size_t count);
  void fail(const char* doing);

  std::string path_;
  std::string temporary_path_;
  ContentKey key_;
  std::ofstream file_;
  std::uint64_t size_ = 0;
  std::string problem_;
};

/// Reads what ArrayFileWriter wrote, in the same order. After the first check that fails everything else
/// fails, too; arrays read before are as they were written, but only ok() at the end says that the file is
/// whole. Never throws but for memory.
class ArrayFileReader {
 public:
  ArrayFileReader(const std::string& path, const ContentKey& key);

  template <typename T>
  void array(std::vector<T>& values) {
    static_assert(IsPlainData<T>::value, "an array of plain data");
    const std::size_t count = beginArray(sizeof(T));
    values.clear();
    if (!ok_) return;
    values.resize(count);
    readArray(values.data(), sizeof(T), count);
    if (!ok_) values.clear();
  }
  template <typename T>
  void value(T& value) {
    static_assert(IsPlainData<T>::value, "plain data");
    if (beginArray(sizeof(T)) != 1) ok_ = false;
    readArray(&value, sizeof(T), 1);
  }
  bool ok() const { return ok_; }
  /// True when all was read and nothing is left.
  bool finish() const { return ok_ && left_ == 0; }

 private:
  std::size_t beginArray(std::size_t element_size);
  void readArray(void* data, std::size_t element_size, std::size_t count);
  bool read(void* data, std::size_t size);

  std::ifstream file_;
  std::uint64_t left_ = 0;
  bool ok_ = false;
};

}  // namespace concave_distance
