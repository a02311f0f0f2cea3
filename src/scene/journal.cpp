#include "journal.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace concave_distance::detail {
namespace {

using Pointer = SceneJournal::value_type;

template <typename IsVoid>
void takeOut(SceneJournal& journal, const IsVoid& is_void) {
  journal.erase(std::remove_if(journal.begin(), journal.end(),
                               [&](const Pointer& operation) { return is_void(*operation); }),
                journal.end());
}

bool haveSameTarget(const SceneOperation& l, const SceneOperation& r) {
  return l.body == r.body && l.other == r.other && l.pair == r.pair;
}

bool isSwitch(OperationKind kind) {
  return kind == OperationKind::AllowContact || kind == OperationKind::DisallowContact ||
         kind == OperationKind::EnablePairs || kind == OperationKind::DisablePairs;
}

// A move stays before an attachment: it says that the body counts as moving once it is detached.
bool makesVoid(const SceneOperation& later, const SceneOperation& earlier) {
  const bool is_same_kind = later.kind == earlier.kind;
  switch (later.kind) {
    case OperationKind::Add:
    case OperationKind::Remove:
      return false;
    case OperationKind::Move:
    case OperationKind::Attach:
      return earlier.kind == OperationKind::Detach && earlier.body == later.body;
    case OperationKind::Detach:
      return (is_same_kind || earlier.kind == OperationKind::Attach) && earlier.body == later.body;
    case OperationKind::AllowContact:
    case OperationKind::DisablePairs:
    case OperationKind::SetMargin:
    case OperationKind::SetWarningDistance:
      return is_same_kind && haveSameTarget(later, earlier);
    case OperationKind::DisallowContact:
      return earlier.kind == OperationKind::AllowContact && haveSameTarget(later, earlier);
    case OperationKind::EnablePairs:
      return (is_same_kind || earlier.kind == OperationKind::DisablePairs) && haveSameTarget(later, earlier);
    case OperationKind::SetEffects:
      return is_same_kind && haveSameTarget(later, earlier) &&
             (later.effects_after || later.effects == earlier.effects);
  }
  return false;
}

// The first one that switches a pair on may have made it, which others may rely on.
void keepFirstAlone(const SceneOperation& later, SceneJournal& journal) {
  bool is_first = true;
  takeOut(journal, [&](const SceneOperation& earlier) {
    return earlier.kind == later.kind && haveSameTarget(later, earlier) && !std::exchange(is_first, false);
  });
}

bool isLastSwitch(const SceneOperation& operation, const SceneJournal& journal) {
  for (auto at = journal.rbegin(); at != journal.rend(); ++at) {
    if ((*at)->kind == OperationKind::Add) return false;
    if (isSwitch((*at)->kind)) return (*at)->kind == operation.kind && haveSameTarget(**at, operation);
  }
  return false;
}

void forgetPartner(const std::string& body, Pointer& operation) {
  const std::vector<std::string>& names = operation->partners.names;
  if (operation->kind != OperationKind::Add || std::find(names.begin(), names.end(), body) == names.end())
    return;
  SceneOperation without = *operation;
  std::vector<std::string>& left = without.partners.names;
  left.erase(std::remove(left.begin(), left.end(), body), left.end());
  without.partners.none = left.empty();
  operation = std::make_shared<const SceneOperation>(std::move(without));
}

/// @return whether the journal had added it
bool forgetBody(const std::string& body, SceneJournal& journal) {
  bool was_added = false;
  takeOut(journal, [&](const SceneOperation& earlier) {
    if (earlier.kind == OperationKind::Remove || (earlier.body != body && earlier.other != body))
      return false;
    was_added = was_added || earlier.kind == OperationKind::Add;
    return true;
  });
  for (Pointer& operation : journal) forgetPartner(body, operation);
  return was_added;
}

bool replaceMove(SceneOperation& operation, SceneJournal& journal) {
  for (auto at = journal.rbegin(); at != journal.rend(); ++at) {
    if ((*at)->kind != OperationKind::Move || (*at)->body != operation.body) continue;
    *at = std::make_shared<const SceneOperation>(std::move(operation));
    return true;
  }
  return false;
}

}  // namespace

std::string nameOf(const SceneOperation& operation) {
  const std::string& target = operation.pair.empty() ? operation.body : operation.pair;
  for (const auto& [name, kind] : kOperationNames) {
    if (kind == operation.kind) return std::string(name) + " '" + target + "'";
  }
  return "'" + target + "'";
}

void record(SceneOperation operation, SceneJournal& journal) {
  if (operation.kind == OperationKind::Remove && forgetBody(operation.body, journal)) return;
  if (isSwitch(operation.kind) && isLastSwitch(operation, journal)) return;
  takeOut(journal, [&](const SceneOperation& earlier) { return makesVoid(operation, earlier); });
  if (operation.kind == OperationKind::DisallowContact) keepFirstAlone(operation, journal);
  if (operation.kind == OperationKind::Move && replaceMove(operation, journal)) return;
  journal.push_back(std::make_shared<const SceneOperation>(std::move(operation)));
}

SceneJournal wholeJournal(const Scene& scene) {
  SceneJournal journal = scene.file ? scene.file->operations : SceneJournal();
  for (const Pointer& operation : scene.operations) record(*operation, journal);
  return journal;
}

}  // namespace concave_distance::detail
