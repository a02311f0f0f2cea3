#pragma once

// What the node answers when it is asked.
//
// What goes in: requests, of which each may be wrong, large, or one of too many.
// What comes out: a response; `success` is false and the message names what is wrong and what to do when a
// request is refused. Nothing that a request holds ends the node, and none delays the cycle: those that take
// long run on threads of their own (ServiceQueues) behind a gate that refuses what is too much (NodeLimits).
// What is kept: nothing of a query; what changes the scene changes the SceneStore, whose next cycle serves
// it. Begin with scene_services.h (bodies, pairs, settings), then distance_queries.h (distances at given
// poses).
