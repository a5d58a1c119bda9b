// An array that is owned, or borrowed from the program.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace tessera {

/// A contiguous array of T that is read as a span. It owns its elements, or it borrows them: then they have to be
/// there, unchanged, until every call that reads the array has returned. A copy of a borrowed array borrows the same
/// elements. Whatever changes a borrowed array copies the elements first, so that the program's own stay as they are.
template <typename T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;
  using const_iterator = const T*;

  Array() = default;
  Array(std::vector<T> values) : owned_(std::move(values)) {}
  Array(std::initializer_list<T> values) : owned_(values) {}

  /// Reads `count` elements at `values` in place.
  static Array borrow(const T* values, std::size_t count) { return borrow(std::span<const T>(values, count)); }
  static Array borrow(std::span<const T> values) {
    Array array;
    array.borrowed_ = values;
    array.borrows_ = true;
    return array;
  }
  bool isBorrowed() const { return borrows_; }

  std::size_t size() const { return borrows_ ? borrowed_.size() : owned_.size(); }
  bool empty() const { return size() == 0; }
  const T* data() const { return borrows_ ? borrowed_.data() : owned_.data(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }
  const T& operator[](std::size_t i) const { return data()[i]; }
  const T& front() const { return data()[0]; }
  const T& back() const { return data()[size() - 1]; }
  operator std::span<const T>() const { return {data(), size()}; }
  std::span<const T> span() const { return *this; }

  /// The elements to change.
  std::vector<T>& own() {
    if (borrows_) {
      owned_.assign(borrowed_.begin(), borrowed_.end());
      borrowed_ = {};
      borrows_ = false;
    }
    return owned_;
  }
  T& operator[](std::size_t i) { return own()[i]; }
  T* begin() { return own().data(); }
  T* end() { return own().data() + own().size(); }
  void push_back(const T& value) { own().push_back(value); }
  template <typename... Arguments>
  void emplace_back(Arguments&&... arguments) {
    own().emplace_back(std::forward<Arguments>(arguments)...);
  }
  void assign(std::size_t count, const T& value) { own().assign(count, value); }
  void reserve(std::size_t count) { own().reserve(count); }
  void resize(std::size_t count) { own().resize(count); }
  void clear() { *this = Array(); }

  /// Element by element, wherever the elements lie.
  friend bool operator==(const Array& a, const Array& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!(a[i] == b[i])) return false;
    return true;
  }

 private:
  std::vector<T> owned_;
  std::span<const T> borrowed_;
  bool borrows_ = false;
};

}  // namespace tessera
