#pragma once

#include <optional>
#include <string>

// Each of these checks holds a parameter to a rule and throws Error naming the parameter and what is allowed.

namespace concave_distance::detail {

[[noreturn]] void refuse(const std::string& where, const std::string& parameter, const std::string& seen,
                         const std::string& allowed);
std::string toText(double value);
void requireShare(const std::string& where, const std::string& parameter, double value);
void requireLength(const std::string& where, const std::string& parameter,
                   const std::optional<double>& value);
void requireNotNegative(const std::string& where, const std::string& parameter, double value);
/// Finite and greater than 0.
void requirePositive(const std::string& where, const std::string& parameter, double value,
                     const std::string& unit);

}  // namespace concave_distance::detail
