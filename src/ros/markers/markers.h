#pragma once

// This folder draws the picture that rviz shows of a scene.
//
// It takes the messages of a cycle (PairNiches, PairContactState), the scene, and where its bodies are.
// It gives one MarkerArray for `markers` and one, latched, for `body_markers` (doc/markers.md).
// It keeps from picture to picture which markers rviz shows, so that others can be deleted; the region of
// the scene, so that letters do not pulsate; the niches of the drawn pairs, which are asked for in turns,
// because opening rviz must not slow the cycle; the number of each row and where it stands in the scene, so
// that it does not jump. The order of a picture, each a header: marker_layout.h (how large, and where the
// list stands), marker_demand.h (whose niches are known), marker_selection.h (which pairs are drawn, which
// bodies red), niche_markers.h and contact_markers.h (lines, points, forces), label_numbers.h (numbers beside
// them), marker_list.h (legend and rows above the scene), body_markers.h (bodies, red ones too).
// scene_markers.h puts them together; marker_style.h holds what a user can set.
