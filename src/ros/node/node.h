#pragma once

// This folder reads the parameters and runs cycles while there is a scene.
//
// It takes private parameters, dynamic reconfiguration, a scene file or a robot description.
// It gives running topics and services, one cycle after the other at `~rate`; from simulation_node the
// motion of bodies in contact.
// It keeps the parameters (one table declares each: node_parameter_table.h), the scene while it is
// loaded and tried again (SceneLoader), the timer and the cycle that it runs (CycleRunner, DistanceCycle).
// Begin with distance_server.h, which owns all parts; distance_node.cpp and distance_nodelet.cpp start it,
// and simulation_runner.h stands beside it. A cycle: read demand, locate, solve, publish, record.
