#include "simulation_log.h"

namespace concave_distance::tools {
namespace {

std::string trajectoryHeader(const Simulation& simulation) {
  std::string header =
      "t,steps,kinetic,gravity_potential,drive_potential,normal_work,friction_work,load_work,drive_work,"
      "drive_loss,balance_error";
  const auto add = [&](const std::string& name, std::initializer_list<const char*> columns) {
    for (const char* column : columns) header += "," + name + "." + column;
  };
  for (const SimulatedBody& body : simulation.bodies()) {
    if (body.motion == BodyMotion::Fixed) continue;
    add(body.name, {"x", "y", "z", "qx", "qy", "qz", "qw", "vx", "vy", "vz", "wx", "wy", "wz", "contact_fx",
                    "contact_fy", "contact_fz", "drive_fx", "drive_fy", "drive_fz"});
  }
  for (const SimulatedPair& pair : simulation.pairs()) {
    add(pair.name, {"distance", "lower_bound", "niches", "regions", "depth", "normal_force",
                    "single_distance", "single_is_wrong"});
  }
  return header;
}

}  // namespace

TrajectoryLog::TrajectoryLog(const std::string& path, const Simulation& simulation)
    : CsvFile(path, trajectoryHeader(simulation)) {}

void TrajectoryLog::write(const Simulation& simulation) {
  const EnergyAccount& energy = simulation.energy();
  cells() << simulation.time() << simulation.counters().steps << energy.kinetic << energy.gravity_potential
          << energy.drive_potential << energy.normal_work << energy.friction_work << energy.load_work
          << energy.drive_work << energy.drive_loss << energy.balanceError();
  for (const SimulatedBody& body : simulation.bodies()) {
    if (body.motion == BodyMotion::Fixed) continue;
    const Eigen::Quaterniond rotation(body.world_from_body.linear());
    cells() << Eigen::Vector3d(body.world_from_body.translation()) << rotation.x() << rotation.y()
            << rotation.z() << rotation.w() << body.velocity << body.angular_velocity
            << body.contact_wrench.force << body.drive_wrench.force;
  }
  for (const SimulatedPair& pair : simulation.pairs()) {
    const bool has_force = pair.contacts.on_b_in_a.force.allFinite();
    double force = has_force ? 0.0 : kNotComputed;
    for (const ContactRegion& region : pair.contacts.regions) {
      if (region.normal_force > 0.0) force += region.normal_force;
    }
    const bool touches = !pair.contacts.regions.empty();
    cells() << (pair.solved ? pair.solution.distance : kNotComputed) << pair.lower_bound
            << (pair.solved ? static_cast<double>(pair.solution.niches.size()) : kNotComputed)
            << pair.contacts.regions.size() << (touches ? pair.contacts.regions.front().overlap.depth : 0.0)
            << force << pair.single_distance << (pair.single_is_wrong ? 1 : 0);
  }
  cells().endLine();
}

ContactLog::ContactLog(const std::string& path)
    : CsvFile(path,
              "t,pair,id,depth,depth_rate,contact_area,volume,normal_force,friction_x,friction_y,friction_z,"
              "point_x,point_y,point_z,normal_x,normal_y,normal_z") {}

void ContactLog::write(const Simulation& simulation) {
  for (const SimulatedPair& pair : simulation.pairs()) {
    const Eigen::Isometry3d& world_from_a = simulation.bodies()[pair.body_a].world_from_body;
    for (const ContactRegion& region : pair.contacts.regions) {
      cells() << simulation.time() << pair.name << region.id << region.overlap.depth << region.depth_rate
              << region.overlap.contact_area << region.overlap.volume << region.normal_force
              << Eigen::Vector3d(world_from_a.linear() * region.friction_on_b_in_a)
              << Eigen::Vector3d(world_from_a * region.point_in_a)
              << Eigen::Vector3d(world_from_a.linear() * region.overlap.normal_in_a);
      cells().endLine();
    }
  }
}

NicheLog::NicheLog(const std::string& path)
    : CsvFile(path, "t,pair,id,distance,closing_speed,a_x,a_y,a_z,b_x,b_y,b_z") {}

void NicheLog::write(const Simulation& simulation) {
  for (const SimulatedPair& pair : simulation.pairs()) {
    if (!pair.solved) continue;
    const Eigen::Isometry3d& world_from_a = simulation.bodies()[pair.body_a].world_from_body;
    for (const TrackedNiche& niche : pair.solution.niches) {
      cells() << simulation.time() << pair.name << niche.id << niche.distance << niche.closing_speed
              << Eigen::Vector3d(world_from_a * niche.point_a_in_a)
              << Eigen::Vector3d(world_from_a * niche.point_b_in_a);
      cells().endLine();
    }
  }
}

}  // namespace concave_distance::tools
