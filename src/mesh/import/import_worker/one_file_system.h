#pragma once

#include <assimp/MemoryIOWrapper.h>

#include <assimp/IOSystem.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace concave_distance::detail {

/// The only file that assimp sees, from memory; no material libraries, textures or archives.
class OneFileSystem : public Assimp::IOSystem {
 public:
  OneFileSystem(std::string name, std::string_view content) : name_(std::move(name)), content_(content) {}

  bool Exists(const char* file) const override { return name_ == file; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (name_ != file || mode[0] != 'r') return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(content_.data()),
                                      content_.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  std::string_view content_;
};

}  // namespace concave_distance::detail
