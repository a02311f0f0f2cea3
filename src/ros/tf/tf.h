#pragma once

// This folder finds the poses of bodies from what tf publishes.
//
// It takes messages on /tf and /tf_static, checked as they come (a transform that is no rigid motion,
// is stamped in the future or has an empty frame is refused and reported), and the frames of a scene's
// bodies. It gives the newest pose of each body, and each pair of bodies at the newest time that the two have
// together, with stamps, and the status that says why there is none (missing, stale). It keeps ten seconds of
// transforms in TransformBuffer; a clock that jumps back empties it. Begin with transform_receiver.h (what is
// accepted), then transform_buffer.h (what is kept), then tf_locate.h (what a cycle or a query asks of it).
// frame_report.h says what a user has to mend. Nothing here knows a distance.
