#pragma once

#include <cstddef>
#include <string_view>

namespace tessera {

/// Size of one of PLY's sixteen scalar types; 0 for another word.
std::size_t plyTypeBytes(std::string_view type);

}  // namespace tessera
