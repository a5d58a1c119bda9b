// An array that is owned, or borrowed from the program.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace tessera {

/// A contiguous array of T that is read as a span. An array owns its elements, or borrows them from the program.
/// Borrowed elements have to be there, unchanged, until every call that reads the array has returned. A copy of a
/// borrowed array borrows the same elements. A function that changes a borrowed array copies the elements first, so the
/// program's elements stay as they are.
template <typename T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;             ///< the type of an element
  using const_iterator = const T*;  ///< reads the elements in order

  Array() = default;  ///< an array without elements
  /// Owns `values`.
  Array(std::vector<T> values) : owned_(std::move(values)) {}
  /// Owns a copy of `values`.
  Array(std::initializer_list<T> values) : owned_(values) {}

  /// Borrows the `count` elements at `values`, which are read in place.
  static Array borrow(const T* values, std::size_t count) { return borrow(std::span<const T>(values, count)); }
  /// Borrows the elements of `values`, which are read in place.
  static Array borrow(std::span<const T> values) {
    Array array;
    array.borrowed_ = values;
    array.borrows_ = true;
    return array;
  }
  /// Whether the elements are borrowed.
  bool isBorrowed() const { return borrows_; }

  /// The number of elements.
  std::size_t size() const { return borrows_ ? borrowed_.size() : owned_.size(); }
  /// Whether the array has no elements.
  bool empty() const { return size() == 0; }
  /// The address of the first element; not to be read where the array is empty.
  const T* data() const { return borrows_ ? borrowed_.data() : owned_.data(); }
  /// The address of the first element; not to be read where the array is empty.
  const T* begin() const { return data(); }
  /// The address behind the last element.
  const T* end() const { return data() + size(); }
  /// Element i, where i < size().
  const T& operator[](std::size_t i) const { return data()[i]; }
  /// The first element of an array that is not empty.
  const T& front() const { return data()[0]; }
  /// The last element of an array that is not empty.
  const T& back() const { return data()[size() - 1]; }
  /// The elements, to be read.
  operator std::span<const T>() const { return {data(), size()}; }
  /// The elements, to be read.
  std::span<const T> span() const { return *this; }

  /// The elements, to be changed. A borrowed array copies its elements first and then owns the copy.
  std::vector<T>& own() {
    if (borrows_) {
      owned_.assign(borrowed_.begin(), borrowed_.end());
      borrowed_ = {};
      borrows_ = false;
    }
    return owned_;
  }
  /// Element i of own(), where i < size().
  T& operator[](std::size_t i) { return own()[i]; }
  /// The address of the first element of own().
  T* begin() { return own().data(); }
  /// The address behind the last element of own().
  T* end() { return own().data() + own().size(); }
  /// Adds an element at the end of own().
  void push_back(const T& value) { own().push_back(value); }
  /// Makes an element from `arguments` at the end of own().
  template <typename... Arguments>
  void emplace_back(Arguments&&... arguments) {
    own().emplace_back(std::forward<Arguments>(arguments)...);
  }
  /// Replaces all elements by `count` copies of `value`.
  void assign(std::size_t count, const T& value) { own().assign(count, value); }
  /// Makes room for `count` elements in own().
  void reserve(std::size_t count) { own().reserve(count); }
  /// Gives own() `count` elements; new elements are value-initialised.
  void resize(std::size_t count) { own().resize(count); }
  /// Drops all elements; the array then borrows nothing.
  void clear() { *this = Array(); }

  /// Compares element by element, whether the arrays own or borrow their elements.
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
