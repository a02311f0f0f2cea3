#pragma once

#include "concave_distance/scene/scene_origin.h"
#include "scene_operation.h"

namespace concave_distance::detail {

/// Appends a recorded operation to a journal and takes out what it makes void: an earlier one on the same
/// body or pairs and the same property; with a removal, all about that body.
void record(SceneOperation operation, SceneJournal& journal);

/// Returns the journal of a scene from its file without operations on.
SceneJournal wholeJournal(const Scene& scene);

}  // namespace concave_distance::detail
