#include <ode/ode.h>

#include <algorithm>
#include <cmath>

#include "engines.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kStep = 1e-4;

struct World {
  dWorldID world;
  dSpaceID space;
  dJointGroupID contacts;
  dSurfaceParameters surface{};

  World() {
    dInitODE2(0);
    world = dWorldCreate();
    space = dHashSpaceCreate(nullptr);
    contacts = dJointGroupCreate(0);
    dCreatePlane(space, 0, 0, 1, 0);
  }
  ~World() {
    dJointGroupDestroy(contacts);
    dSpaceDestroy(space);
    dWorldDestroy(world);
    dCloseODE();
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  Trajectory run(dBodyID body, int axis, double duration, double interval) {
    Trajectory trajectory;
    const int steps = static_cast<int>(std::lround(interval / kStep));
    for (int line = 0; line * interval <= duration + 1e-9; ++line) {
      for (int k = 0; line > 0 && k < steps; ++k) {
        dSpaceCollide(space, this, &World::touch);
        dWorldStep(world, kStep);
        dJointGroupEmpty(contacts);
      }
      trajectory.push_back({line * interval, dBodyGetPosition(body)[axis], dBodyGetLinearVel(body)[axis]});
    }
    return trajectory;
  }

  static void touch(void* data, dGeomID a, dGeomID b) {
    auto& self = *static_cast<World*>(data);
    constexpr int kMost = 8;
    dContact contact[kMost];
    const int count = dCollide(a, b, kMost, &contact[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      contact[i].surface = self.surface;
      const dJointID joint = dJointCreateContact(self.world, self.contacts, &contact[i]);
      dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
    }
  }
};

// Hunt and Crossley's restitution in closed form: v/s - ln(1 + s v)/s^2 is equal at v and at -e v, s = 1.5 c.
double restitution(double speed, double dissipation) {
  const double s = 1.5 * dissipation;
  const auto potential = [s](double v) { return v / s - std::log1p(s * v) / (s * s); };
  double low = 0.0;
  double high = std::min(speed, (1.0 - 1e-15) / s);
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (potential(-middle) < potential(speed) ? low : high) = middle;
  }
  return 0.5 * (low + high) / speed;
}

}  // namespace

Trajectory odeBall(const BallScene& scene) {
  World world;
  dWorldSetGravity(world.world, 0, 0, -9.81);
  const dBodyID body = dBodyCreate(world.world);
  dMass mass;
  dMassSetSphereTotal(&mass, scene.mass, scene.radius);
  dBodySetMass(body, &mass);
  dBodySetPosition(body, 0, 0, scene.height);
  dGeomSetBody(dCreateSphere(world.space, scene.radius), body);
  const double speed = std::sqrt(2.0 * 9.81 * (scene.height - scene.radius));
  world.surface.mode = dContactBounce;
  world.surface.mu = 0.0;
  world.surface.bounce = restitution(speed, scene.dissipation);
  return world.run(body, 2, scene.duration, scene.interval);
}

Trajectory odeBox(const BoxScene& scene) {
  World world;
  dWorldSetGravity(world.world, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
  const dBodyID body = dBodyCreate(world.world);
  dMass mass;
  dMassSetBoxTotal(&mass, scene.mass, scene.size.x(), scene.size.y(), scene.size.z());
  dBodySetMass(body, &mass);
  dBodySetPosition(body, 0, 0, 0.5 * scene.size.z());
  dGeomSetBody(dCreateBox(world.space, scene.size.x(), scene.size.y(), scene.size.z()), body);
  world.surface.mode = dContactApprox1;
  world.surface.mu = scene.friction;
  return world.run(body, 0, scene.duration, scene.interval);
}

}  // namespace concave_distance::benchmark
