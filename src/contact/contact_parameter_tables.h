#pragma once

#include "base/parameter.h"
#include "concave_distance/contact/friction.h"
#include "concave_distance/contact/material.h"
#include "concave_distance/contact/normal_force.h"

namespace concave_distance {

/// Every parameter of contact: files, messages and documents are made from these tables.
const ParameterTable<NormalForceSettings>& normalForceParameters();
const ParameterTable<FrictionSettings>& frictionParameters();
const ParameterTable<Material>& materialParameters();

}  // namespace concave_distance
