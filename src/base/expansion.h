#pragma once

#include <array>
#include <cmath>

#include "double_double.h"

namespace concave_distance::detail {

/// An exact sum of doubles that do not overlap, the least first (Shewchuk 1997, "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates"). Sums, differences and products are exact
/// as long as nothing over- or underflows; what includes this is compiled with -ffp-contract=off. Terms
/// without value are dropped.
class Expansion {
 public:
  Expansion() = default;
  Expansion(const Expansion& other) : count_(other.count_) { copyTerms(other); }
  Expansion& operator=(const Expansion& other) {
    count_ = other.count_;
    copyTerms(other);
    return *this;
  }

  /// a - b
  static Expansion difference(double a, double b) {
    Expansion result;
    const DoubleDouble d = twoSum(a, -b);
    result.append(d.low);
    result.append(d.high);
    return result;
  }

  int sign() const {
    if (count_ == 0) return 0;
    return term_[count_ - 1] > 0.0 ? 1 : -1;
  }
  /// Rounded, relative error of a few machine epsilons at most.
  double value() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < count_; ++i) sum += term_[i];
    return sum;
  }

  Expansion operator-() const {
    Expansion result(*this);
    for (std::size_t i = 0; i < count_; ++i) result.term_[i] = -term_[i];
    return result;
  }
  /// Shewchuk's fast-expansion-sum.
  friend Expansion operator+(const Expansion& e, const Expansion& f) {
    if (e.count_ == 0) return f;
    if (f.count_ == 0) return e;
    Expansion result;
    std::size_t i = 0;
    std::size_t j = 0;
    const auto next = [&]() {
      if (j == f.count_ || (i < e.count_ && std::abs(e.term_[i]) < std::abs(f.term_[j]))) return e.term_[i++];
      return f.term_[j++];
    };
    double sum = next();
    while (i < e.count_ || j < f.count_) {
      const DoubleDouble s = twoSum(sum, next());
      result.append(s.low);
      sum = s.high;
    }
    result.append(sum);
    result.compressIfLong();
    return result;
  }
  friend Expansion operator-(const Expansion& e, const Expansion& f) { return e + (-f); }
  friend Expansion operator*(const Expansion& e, const Expansion& f) {
    Expansion result;
    for (std::size_t j = 0; j < f.count_; ++j) result = result + e.scaled(f.term_[j]);
    result.compress();
    return result;
  }

 private:
  /// Two compressed factors of 80 terms each, which would span all exponents of a double, fit in.
  static constexpr std::size_t kCapacity = 400;

  void copyTerms(const Expansion& other) {
    for (std::size_t i = 0; i < count_; ++i) term_[i] = other.term_[i];
  }
  void append(double value) {
    if (value != 0.0 && count_ < kCapacity) term_[count_++] = value;
  }
  /// Shewchuk's scale-expansion.
  Expansion scaled(double factor) const {
    Expansion result;
    if (count_ == 0) return result;
    DoubleDouble product = twoProduct(term_[0], factor);
    result.append(product.low);
    double sum = product.high;
    for (std::size_t i = 1; i < count_; ++i) {
      product = twoProduct(term_[i], factor);
      const DoubleDouble low = twoSum(sum, product.low);
      result.append(low.low);
      const DoubleDouble high = quickTwoSum(product.high, low.high);
      result.append(high.low);
      sum = high.high;
    }
    result.append(sum);
    return result;
  }
  void compressIfLong() {
    if (count_ > kCapacity / 5) compress();
  }
  /// Shewchuk's compress: as few terms as nearly possible.
  void compress() {
    if (count_ < 2) return;
    std::size_t bottom = count_ - 1;
    double sum = term_[bottom];
    for (std::size_t i = count_ - 1; i-- > 0;) {
      const DoubleDouble s = quickTwoSum(sum, term_[i]);
      sum = s.high;
      if (s.low != 0.0) {
        term_[bottom--] = s.high;
        sum = s.low;
      }
    }
    term_[bottom] = sum;
    std::size_t top = 0;
    for (std::size_t i = bottom + 1; i < count_; ++i) {
      const DoubleDouble s = quickTwoSum(term_[i], sum);
      sum = s.high;
      if (s.low != 0.0) term_[top++] = s.low;
    }
    term_[top++] = sum;
    count_ = term_[top - 1] == 0.0 ? 0 : top;
  }

  std::array<double, kCapacity> term_;
  std::size_t count_ = 0;
};

}  // namespace concave_distance::detail
