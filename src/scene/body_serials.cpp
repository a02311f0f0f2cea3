#include "body_serials.h"

#include <algorithm>
#include <memory>
#include <unordered_set>
#include <utility>
#include <vector>

namespace concave_distance::detail {
namespace {

std::uint64_t renumbered(const Serials& serials, std::uint64_t serial) {
  const auto found = serials.find(serial);
  return found == serials.end() ? serial : found->second;
}

std::unordered_set<std::uint64_t> renumbered(const Serials& serials,
                                             const std::unordered_set<std::uint64_t>& all) {
  std::unordered_set<std::uint64_t> result;
  for (const std::uint64_t serial : all) result.insert(renumbered(serials, serial));
  return result;
}

using SerialPairs = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

SerialPairs renumbered(const Serials& serials, const SerialPairs& pairs) {
  SerialPairs result;
  for (const auto& [a, b] : pairs)
    result.emplace_back(std::minmax(renumbered(serials, a), renumbered(serials, b)));
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

void renumber(Scene& scene, const Serials& serials) {
  if (serials.empty()) return;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    SceneBody& body = scene.bodies.edit(i);
    body.serial = renumbered(serials, body.serial);
    body.carrier = renumbered(serials, body.carrier);
    if (body.attachment) {
      Attachment attachment = *body.attachment;
      attachment.parent_serial = renumbered(serials, attachment.parent_serial);
      attachment.carrier_before = renumbered(serials, attachment.carrier_before);
      attachment.may_touch = renumbered(serials, attachment.may_touch);
      body.attachment = std::make_shared<const Attachment>(std::move(attachment));
    }
  }
  if (scene.rules.filtered)
    scene.rules.filtered = std::make_shared<const SerialPairs>(renumbered(serials, *scene.rules.filtered));
}

}  // namespace concave_distance::detail
