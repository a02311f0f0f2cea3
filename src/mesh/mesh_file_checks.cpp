#include "mesh_file_checks.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

constexpr const char* kExportAgain = "export the mesh again";

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The number in `size` bytes.
std::uint64_t wholeNumber(const unsigned char* bytes, std::size_t size, bool little_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = (value << 8U) | bytes[little_endian ? size - 1 - i : i];
  }
  return value;
}

/// A binary STL has 50 bytes for each facet it announces; an ASCII one has no facet after its last
/// "endsolid".
void checkStlIsWhole(const std::string& path, std::ifstream& stream, std::uintmax_t size) {
  constexpr std::size_t kHeader = 84;
  std::array<unsigned char, kHeader> header{};
  stream.read(reinterpret_cast<char*>(header.data()), kHeader);
  if (stream.gcount() == kHeader && size == kHeader + 50 * wholeNumber(&header[80], 4, true)) {
    return;
  }
  stream.clear();
  const auto tail_size = static_cast<std::streamoff>(std::min<std::uintmax_t>(size, 4096));
  stream.seekg(-tail_size, std::ios::end);
  std::string tail(static_cast<std::size_t>(tail_size), '\0');
  stream.read(tail.data(), tail_size);
  tail = lowerCase(std::move(tail));
  const std::size_t end = tail.rfind("endsolid");
  if (end == std::string::npos || tail.find("facet normal", end) != std::string::npos) {
    throw Error(path,
                "the STL file breaks off: " + std::to_string(size) +
                    " bytes are not what a binary header announces, nor is 'endsolid' the end of a text",
                kExportAgain);
  }
}

struct PlyProperty {
  std::size_t count_size = 0;  ///< bytes of a list's length; 0 for a single value
  std::size_t value_size = 0;
};

struct PlyElement {
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::string format;
  std::vector<PlyElement> elements;
};

/// 0 for a name that is no type.
std::size_t plyTypeSize(const std::string& type) {
  static const std::vector<std::pair<std::size_t, std::vector<std::string>>> sizes{
      {1, {"char", "uchar", "int8", "uint8"}},
      {2, {"short", "ushort", "int16", "uint16"}},
      {4, {"int", "uint", "int32", "uint32", "float", "float32"}},
      {8, {"double", "float64"}}};
  for (const auto& [size, names] : sizes) {
    if (std::find(names.begin(), names.end(), type) != names.end()) {
      return size;
    }
  }
  return 0;
}

/// Empty when the header is not that of a PLY file.
PlyHeader readPlyHeader(std::ifstream& stream) {
  PlyHeader header;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "format") {
      words >> header.format;
    } else if (word == "element") {
      PlyElement element;
      words >> word >> element.count;
      header.elements.push_back(element);
    } else if (word == "property" && !header.elements.empty()) {
      PlyProperty property;
      words >> word;
      if (word == "list") {
        words >> word;
        property.count_size = plyTypeSize(word);
        words >> word;
      }
      property.value_size = plyTypeSize(word);
      header.elements.back().properties.push_back(property);
    } else if (word == "end_header") {
      return header;
    }
  }
  return {};
}

/// Passes over the values of a PLY body; false when they run out.
class PlyBody {
 public:
  PlyBody(std::ifstream& stream, const std::string& format) : stream_(stream), format_(format) {}

  bool skip(std::size_t value_size, std::uint64_t count) {
    if (format_ == "ascii") {
      for (std::uint64_t i = 0; i < count; ++i) {
        if (!(stream_ >> word_)) {
          return false;
        }
      }
      return true;
    }
    stream_.ignore(static_cast<std::streamsize>(count * value_size));
    return static_cast<std::uint64_t>(stream_.gcount()) == count * value_size;
  }

  bool readCount(std::size_t size, std::uint64_t& count) {
    if (format_ == "ascii") {
      return static_cast<bool>(stream_ >> count);
    }
    std::array<unsigned char, 8> bytes{};
    stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    count = wholeNumber(bytes.data(), size, format_ == "binary_little_endian");
    return static_cast<bool>(stream_) && count < (std::uint64_t{1} << 32U);
  }

 private:
  std::ifstream& stream_;
  const std::string& format_;
  std::string word_;
};

void checkPlyIsWhole(const std::string& path, std::ifstream& stream) {
  const PlyHeader header = readPlyHeader(stream);
  if (header.elements.empty()) {
    throw Error(path, "the PLY header has no element or no end", kExportAgain);
  }
  PlyBody body(stream, header.format);
  for (const PlyElement& element : header.elements) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        std::uint64_t count = 1;
        const bool there = (property.count_size == 0 || body.readCount(property.count_size, count)) &&
                           body.skip(property.value_size, count);
        if (!there) {
          throw Error(path,
                      "the PLY file breaks off before the last of the elements that its header announces",
                      kExportAgain);
        }
      }
    }
  }
}

/// Assimp's COLLADA reader never returns from an index list with something other than numbers in it, and
/// reads out of bounds when an array does not state its length.
void checkDaeLists(const std::string& path, std::ifstream& stream) {
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  for (std::size_t open = text.find('<'); open != std::string::npos; open = text.find('<', open + 1)) {
    if (text.compare(open, 4, "<!--") == 0) {
      open = text.find("-->", open);
      if (open == std::string::npos) {
        break;
      }
      continue;
    }
    const std::size_t close = text.find('>', open);
    if (close == std::string::npos) {
      break;  // malformed: assimp says so
    }
    const std::string tag = text.substr(open + 1, text.find_first_of(" \t\r\n/>", open + 1) - open - 1);
    if ((tag == "float_array" || tag == "accessor") &&
        text.substr(open, close - open).find("count=") == std::string::npos) {
      throw Error(path, "a <" + tag + "> does not state its count", kExportAgain);
    }
    const std::size_t end = std::min(text.find('<', close), text.size());
    if ((tag == "p" || tag == "vcount") && text.find_first_not_of("0123456789 \t\r\n", close + 1) < end) {
      throw Error(path, "a <" + tag + "> holds something other than indices", kExportAgain);
    }
  }
}

}  // namespace

std::string lowerCaseExtension(const std::string& path) {
  return lowerCase(std::filesystem::path(path).extension().string());
}

void checkMeshFile(const std::string& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (!std::filesystem::exists(status)) {
    throw Error(path, "there is no such file", "check the path and the package it is in");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw Error(path, "this is not a file", "name a mesh file");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw Error(path, "the file cannot be opened", "check its permissions");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure || size == 0) {
    throw Error(path, "the file is empty", kExportAgain);
  }
  const std::string extension = lowerCaseExtension(path);
  if (extension == ".stl") {
    checkStlIsWhole(path, stream, size);
  } else if (extension == ".ply") {
    checkPlyIsWhole(path, stream);
  } else if (extension == ".dae") {
    checkDaeLists(path, stream);
  }
}

}  // namespace concave_distance::detail
