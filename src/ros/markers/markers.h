#pragma once

// This folder draws the picture that rviz shows of a scene.
//
// It takes the messages of a cycle (PairNiches, PairContactState), the scene, and where its bodies are.
// It gives one MarkerArray for `markers` and one, latched, for `body_markers` (doc/markers.md).
// It keeps from picture to picture which markers rviz shows, so that others can be deleted; the size of the
// scene, so that letters do not pulsate; the messages of the drawn pairs, whose niches the next picture needs
// and which are drawn again when their transforms have become stale. The order of a picture, each a header:
// scene_size.h (how large), marker_selection.h (which pairs are drawn, which bodies red), niche_markers.h and
// contact_markers.h (lines, points, forces, labels), body_markers.h (bodies, red ones too). scene_markers.h
// puts them together; marker_style.h holds what a user can set.
