# The messages, services and dynamic_reconfigure files of the package; called before catkin_package().
set(CONCAVE_DISTANCE_MESSAGES
  Alert.msg
  BodyInfo.msg
  BodyState.msg
  ClearanceFeedback.msg
  Constraint.msg
  Constraints.msg
  Contact.msg
  Contacts.msg
  DistanceQuery.msg
  Distances.msg
  GroupInfo.msg
  GuardState.msg
  Nearest.msg
  Niche.msg
  NicheChange.msg
  Niches.msg
  OperationFault.msg
  PairBracket.msg
  PairContactState.msg
  PairDistance.msg
  PairInfo.msg
  PairNiches.msg
  PairStatus.msg
  Problem.msg
  SceneFile.msg
  SceneMoves.msg
  SceneOperation.msg
  SimulationState.msg
  SolveCost.msg
  UnlistedPair.msg
)
set(CONCAVE_DISTANCE_SERVICES
  AddBody.srv
  ApplyScene.srv
  CancelClearance.srv
  GetClearance.srv
  GetDistance.srv
  GetDistances.srv
  GetScene.srv
  ListBodies.srv
  Reload.srv
  RemoveBody.srv
  ResetTracking.srv
  SaveScene.srv
  SetEffects.srv
  SetPairEnabled.srv
  SetWarningDistance.srv
)
set(CONCAVE_DISTANCE_DYNAMIC_RECONFIGURE
  config/ConcaveDistance.cfg
)

if(CONCAVE_DISTANCE_MESSAGES)
  add_message_files(FILES ${CONCAVE_DISTANCE_MESSAGES})
endif()
if(CONCAVE_DISTANCE_SERVICES)
  add_service_files(FILES ${CONCAVE_DISTANCE_SERVICES})
endif()
if(CONCAVE_DISTANCE_MESSAGES OR CONCAVE_DISTANCE_SERVICES)
  generate_messages(DEPENDENCIES geometry_msgs sensor_msgs shape_msgs std_msgs trajectory_msgs)
endif()
if(CONCAVE_DISTANCE_DYNAMIC_RECONFIGURE)
  generate_dynamic_reconfigure_options(${CONCAVE_DISTANCE_DYNAMIC_RECONFIGURE})
endif()
