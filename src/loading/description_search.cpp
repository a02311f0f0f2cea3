#include "description_search.h"

namespace concave_distance {
namespace {

bool isXml(const std::string& text) {
  return text.find('<') != std::string::npos;
}

// "/arm/node" -> "/arm" -> "" (the root)
std::string namespaceAbove(const std::string& space) {
  const std::size_t slash = space.rfind('/');
  return slash == std::string::npos ? std::string() : space.substr(0, slash);
}

}  // namespace

std::optional<FoundDescription> searchDescription(const std::string& private_namespace,
                                                  const std::string& name, const ParameterText& read) {
  const auto found = [&](const std::string& key) -> std::optional<FoundDescription> {
    std::optional<std::string> text = read(key);
    if (!text) {
      return std::nullopt;
    }
    const bool is_xml = isXml(*text);
    return FoundDescription{key, std::move(*text), is_xml};
  };
  if (!name.empty() && name.front() == '/') {
    return found(name);
  }
  std::optional<FoundDescription> other;
  std::string space = private_namespace == "/" ? std::string() : private_namespace;
  for (bool is_private = true;; is_private = false) {
    std::optional<FoundDescription> here = found(std::string(space).append("/").append(name));
    if (here && here->is_xml) {
      return here;
    }
    if (here && !is_private && !other) {
      other = std::move(here);
    }
    if (space.empty()) {
      return other;
    }
    space = namespaceAbove(space);
  }
}

}  // namespace concave_distance
