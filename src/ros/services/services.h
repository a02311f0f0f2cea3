#pragma once

// This folder answers the requests of services.
//
// It takes requests, of which each may be wrong, large, or one of too many.
// It gives a response; `success` is false and the message names what is wrong and what to do when a
// request is refused. Nothing that a request holds ends the node, and none delays the cycle: those that take
// long run on threads of their own (ServiceQueues) behind a gate that refuses what is too much (NodeLimits).
// It keeps nothing of a query; what changes the scene changes the SceneStore, whose next cycle serves
// it. Begin with scene_services.h (bodies, pairs, settings), then answer_query.h (the distance at given
// poses) and distance_queries.h (calls with one query or many).
