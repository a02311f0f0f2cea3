#pragma once

// This folder finds the poses of bodies from what tf publishes.
//
// It takes messages on /tf and /tf_static, checked as they come (a transform that is no rigid motion,
// is stamped in the future or has an empty frame is refused and reported), and the frames of a scene's
// bodies. It gives the poses of all bodies in a cycle, or of a pair in a query, at the newest times that they
// have together, with stamps, and the status that says why there is none (missing, stale, not finite). It
// keeps ten seconds of transforms, each with its clock, in TransformBuffer; a clock that jumps back empties
// it. Begin with transform_receiver.h (what is accepted), then transform_buffer.h (what is kept), then
// frame_poses.h (what a cycle asks of it) and tf_poses.h (what a query does). frame_report.h says what a user
// has to mend. Nothing here knows a distance.
