#include "parameter_checks.h"

#include <cmath>

#include "concave_distance/base/error.h"
#include "number_text.h"

namespace concave_distance::detail {

void refuse(const std::string& where, const std::string& parameter, const std::string& seen,
            const std::string& allowed) {
  throw Error(where, parameter + " is " + seen, "allowed: " + allowed);
}

std::string toText(double value) {
  return numberText(value);
}

void requireShare(const std::string& where, const std::string& parameter, double value) {
  if (!(value >= 0.0 && value <= 1.0)) {
    refuse(where, parameter, toText(value), "0 to 1");
  }
}

void requireLength(const std::string& where, const std::string& parameter,
                   const std::optional<double>& value) {
  if (value && !(*value > 0.0)) {
    refuse(where, parameter, toText(*value), "a positive length in metres, or leave it out");
  }
}

void requireNotNegative(const std::string& where, const std::string& parameter, double value) {
  if (!(value >= 0.0) || std::isinf(value)) {
    refuse(where, parameter, toText(value), "0 or more, finite");
  }
}

void requirePositive(const std::string& where, const std::string& parameter, double value,
                     const std::string& unit) {
  if (!(value > 0.0) || std::isinf(value)) {
    refuse(where, parameter, toText(value), "greater than 0, " + unit);
  }
}

}  // namespace concave_distance::detail
