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
  using value_type = T;             ///< of an element
  using const_iterator = const T*;  ///< of begin() and end()

  Array() = default;  ///< empty
  /// Owns these elements.
  Array(std::vector<T> values) : owned_(std::move(values)) {}
  /// Owns these elements.
  Array(std::initializer_list<T> values) : owned_(values) {}

  /// Reads `count` elements at `values` in place.
  static Array borrow(const T* values, std::size_t count) { return borrow(std::span<const T>(values, count)); }
  /// Reads these elements in place.
  static Array borrow(std::span<const T> values) {
    Array array;
    array.borrowed_ = values;
    array.borrows_ = true;
    return array;
  }
  /// Whether the elements are the program's.
  bool isBorrowed() const { return borrows_; }

  std::size_t size() const { return borrows_ ? borrowed_.size() : owned_.size(); }  ///< number of elements
  bool empty() const { return size() == 0; }                                        ///< whether there is no element
  const T* data() const { return borrows_ ? borrowed_.data() : owned_.data(); }     ///< the first element
  const T* begin() const { return data(); }                                         ///< the first element
  const T* end() const { return data() + size(); }                                  ///< one past the last element
  const T& operator[](std::size_t i) const { return data()[i]; }                    ///< element i, i < size()
  const T& front() const { return data()[0]; }                                      ///< of an array that is not empty
  const T& back() const { return data()[size() - 1]; }                              ///< of an array that is not empty
  operator std::span<const T>() const { return {data(), size()}; }                  ///< all elements
  std::span<const T> span() const { return *this; }                                 ///< all elements

  /// The elements to change.
  std::vector<T>& own() {
    if (borrows_) {
      owned_.assign(borrowed_.begin(), borrowed_.end());
      borrowed_ = {};
      borrows_ = false;
    }
    return owned_;
  }
  T& operator[](std::size_t i) { return own()[i]; }           ///< element i to change, i < size()
  T* begin() { return own().data(); }                         ///< the first element, to change
  T* end() { return own().data() + own().size(); }            ///< one past the last element
  void push_back(const T& value) { own().push_back(value); }  ///< adds an element at the end
  /// Makes an element of these arguments at the end.
  template <typename... Arguments>
  void emplace_back(Arguments&&... arguments) {
    own().emplace_back(std::forward<Arguments>(arguments)...);
  }
  void assign(std::size_t count, const T& value) { own().assign(count, value); }  ///< so many elements of one value
  void reserve(std::size_t count) { own().reserve(count); }                       ///< makes room for so many elements
  void resize(std::size_t count) { own().resize(count); }                         ///< adds zeros, or drops elements
  void clear() { *this = Array(); }                                               ///< drops all elements

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
