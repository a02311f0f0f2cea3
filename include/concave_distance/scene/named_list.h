#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace concave_distance {

/// Positions in a list by hash: open addressing in one block of memory, so that a copy is fast.
class PlaceIndex {
 public:
  /// The first place with this hash that `is_it` accepts.
  template <typename IsIt>
  std::optional<std::size_t> find(std::size_t hash, const IsIt& is_it) const {
    if (slots_.empty()) return std::nullopt;
    const auto short_hash = static_cast<std::uint32_t>(hash);
    for (std::size_t slot = short_hash & mask(); slots_[slot].place != kFree; slot = (slot + 1) & mask()) {
      if (slots_[slot].hash == short_hash && is_it(std::size_t{slots_[slot].place})) {
        return slots_[slot].place;
      }
    }
    return std::nullopt;
  }

  void insert(std::size_t hash, std::size_t place) {
    if (2 * (used_ + 1) > slots_.size()) grow();
    put({static_cast<std::uint32_t>(hash), static_cast<std::uint32_t>(place)});
    ++used_;
  }

 private:
  static constexpr std::uint32_t kFree = 0xffffffffU;
  struct Slot {
    std::uint32_t hash = 0;
    std::uint32_t place = kFree;
  };

  std::size_t mask() const { return slots_.size() - 1; }
  void put(const Slot& value) {
    std::size_t slot = value.hash & mask();
    while (slots_[slot].place != kFree) slot = (slot + 1) & mask();
    slots_[slot] = value;
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 16 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.place != kFree) put(slot);
    }
  }

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

/// Named values, in order. A copy shares the values and is fast, so that a scene of thousands of bodies can
/// be edited while others read the previous one. A name is found in O(1).
template <typename T>
class NamedList {
 public:
  using value_type = T;
  using Pointer = std::shared_ptr<T>;

  class const_iterator {  // NOLINT(readability-identifier-naming): named as in std::vector
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    const_iterator() = default;
    explicit const_iterator(const Pointer* at) : at_(at) {}
    reference operator*() const { return **at_; }
    pointer operator->() const { return at_->get(); }
    const_iterator& operator++() {
      ++at_;
      return *this;
    }
    const_iterator operator++(int) { return const_iterator(at_++); }
    const_iterator& operator--() {
      --at_;
      return *this;
    }
    const_iterator& operator+=(difference_type n) {
      at_ += n;
      return *this;
    }
    friend const_iterator operator+(const_iterator i, difference_type n) { return i += n; }
    friend const_iterator operator-(const_iterator i, difference_type n) { return i += -n; }
    friend difference_type operator-(const_iterator l, const_iterator r) { return l.at_ - r.at_; }
    friend bool operator==(const_iterator l, const_iterator r) { return l.at_ == r.at_; }
    friend bool operator!=(const_iterator l, const_iterator r) { return l.at_ != r.at_; }
    friend bool operator<(const_iterator l, const_iterator r) { return l.at_ < r.at_; }

   private:
    const Pointer* at_ = nullptr;
  };
  using iterator = const_iterator;

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  const T& operator[](std::size_t i) const { return *values_[i]; }
  const T& at(std::size_t i) const { return *values_.at(i); }
  const T& front() const { return *values_.front(); }
  const T& back() const { return *values_.back(); }
  const_iterator begin() const { return const_iterator(values_.data()); }
  const_iterator end() const { return const_iterator(values_.data() + values_.size()); }
  /// The value itself, shared by every copy of the list in which it was not edited.
  std::shared_ptr<const T> share(std::size_t i) const { return values_[i]; }

  /// Index of the value with this name.
  std::optional<std::size_t> find(const std::string& name) const {
    return by_name_.find(std::hash<std::string>{}(name),
                         [&](std::size_t place) { return values_[place]->name == name; });
  }

  void push_back(T value) {  // NOLINT(readability-identifier-naming): named as in std::vector
    append(std::make_shared<T>(std::move(value)));
  }
  /// Appends value i of another list, shared with it.
  void appendShared(const NamedList& other, std::size_t i) { append(other.values_[i]); }
  /// Lends an element for changing anything but its name: copies the value if other lists or users share it.
  T& edit(std::size_t i) {
    Pointer& value = values_.at(i);
    if (value.use_count() > 1) value = std::make_shared<T>(*value);
    std::atomic_thread_fence(std::memory_order_acquire);  // sees all accesses of the last other user
    return *value;
  }

 protected:
  void append(Pointer value) {
    by_name_.insert(std::hash<std::string>{}(value->name), values_.size());
    values_.push_back(std::move(value));
  }
  const Pointer& pointer(std::size_t i) const { return values_[i]; }

 private:
  std::vector<Pointer> values_;
  PlaceIndex by_name_;
};

}  // namespace concave_distance
