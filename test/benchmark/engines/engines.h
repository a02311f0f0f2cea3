#pragma once

#include <Eigen/Core>
#include <vector>

namespace concave_distance::benchmark {

struct TrajectoryPoint {
  double time;      ///< s
  double place;     ///< m
  double velocity;  ///< m/s
};
using Trajectory = std::vector<TrajectoryPoint>;

/// A ball over the plane z = 0, dropped from rest.
struct BallScene {
  double radius;
  double mass;
  double height;           ///< of the centre
  double contact_modulus;  ///< E* of the contact, Pa
  double dissipation;      ///< c of Hunt and Crossley, s/m
  double duration;
  double interval;  ///< between points
};

/// A box that stands on the plane z = 0 under inclined gravity; the way is that along x.
struct BoxScene {
  Eigen::Vector3d size;
  double mass;
  double foundation_stiffness;  ///< Pa/m
  double dissipation;           ///< c in 1 + 3/2 c d', s/m
  double friction;              ///< static and dynamic
  Eigen::Vector3d gravity;
  double duration;
  double interval;
};

/// Hunt and Crossley's force between a true sphere and a half-space, accuracy 1e-8.
Trajectory simbodyBall(const BallScene& scene);
/// A bed of springs at the centres of the faces of a fine mesh, friction regularised at 1e-3 m/s.
Trajectory simbodyBox(const BoxScene& scene);
/// Rigid bounces with the restitution that Hunt and Crossley give the first impact; step 0.1 ms.
Trajectory odeBall(const BallScene& scene);
/// Rigid contact with Coulomb's pyramid; step 0.1 ms.
Trajectory odeBox(const BoxScene& scene);

}  // namespace concave_distance::benchmark
