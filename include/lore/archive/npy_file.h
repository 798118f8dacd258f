#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lore {

/// Arrays in NumPy's own file format (.npy, version 1.0: numpy.lib.format), the door to Python and R.

struct NpyArray {
    std::vector<std::size_t> shape;
    std::vector<float> values;   ///< row-major
};

/// Reads little-endian float32 ("<f4"), float64 ("<f8") or uint32 ("<u4", both rounded to float) in C order, all
/// finite. Throws Error: missing, cut, too long, not NPY, another type or order, NaN or infinity.
NpyArray read_npy(std::string const& path);

/// Atomic; throws Error. Precondition: the product of `shape` is values.size().
void write_npy(std::string const& path, std::span<float const> values, std::span<std::size_t const> shape);
void write_npy(std::string const& path, std::span<double const> values, std::span<std::size_t const> shape);
void write_npy(std::string const& path, std::span<std::uint32_t const> values, std::span<std::size_t const> shape);

}   // namespace lore
