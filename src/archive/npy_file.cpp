#include <lore/archive/npy_file.h>

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

static_assert(std::endian::native == std::endian::little, "NPY arrays are read and written as they lie in memory");

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t data_alignment = 64;   ///< of the data, by the format's definition

[[noreturn]] void refuse_array(std::string const& path, std::string const& reason,
                               std::string_view remedy = "Write it with numpy.save.") {
    throw Error(fmt::format("cannot read {}", path), reason, remedy);
}

/// The header's Python dictionary, whose three keys numpy writes in any order.
struct Header {
    std::string descr;
    bool fortran_order = false;
    std::vector<std::size_t> shape;
};

/// A strict reader of that dictionary: {'descr': '<f4', 'fortran_order': False, 'shape': (3, 20), }
class HeaderReader {
public:
    explicit HeaderReader(std::string_view text) : text_(text) {}

    std::optional<Header> read() {
        Header header;
        int seen = 0;
        if (!take('{')) return std::nullopt;
        while (!take('}')) {
            std::string const key = string();
            if (!take(':')) return std::nullopt;
            if (key == "descr") {
                header.descr = string();
                seen |= 1;
            } else if (key == "fortran_order") {
                header.fortran_order = word() == "True";
                seen |= 2;
            } else if (key == "shape") {
                if (!shape(header.shape)) return std::nullopt;
                seen |= 4;
            } else return std::nullopt;
            if (!take(',') && peek() != '}') return std::nullopt;
        }
        if (peek() != '\0' || seen != 7) return std::nullopt;
        return header;
    }

private:
    char peek() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char wanted) {
        if (peek() != wanted) return false;
        ++at_;
        return true;
    }
    std::string string() {
        char const quote = peek();
        if (quote != '\'' && quote != '"') return "";
        std::size_t const end = text_.find(quote, at_ + 1);
        if (end == std::string_view::npos) return "";
        std::string const found{text_.substr(at_ + 1, end - at_ - 1)};
        at_ = end + 1;
        return found;
    }
    std::string_view word() {
        peek();
        std::size_t const start = at_;
        while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]))) ++at_;
        return text_.substr(start, at_ - start);
    }
    bool shape(std::vector<std::size_t>& sizes) {
        if (!take('(')) return false;
        while (!take(')')) {
            peek();
            std::size_t size = 0;
            auto const [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), size);
            if (error != std::errc{}) return false;
            at_ = static_cast<std::size_t>(end - text_.data());
            sizes.push_back(size);
            if (!take(',') && peek() != ')') return false;
        }
        return true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

template <class Stored>
std::vector<float> values_of(std::span<std::byte const> data, std::string const& path) {
    std::vector<float> values(data.size() / sizeof(Stored));
    for (std::size_t i = 0; i < values.size(); ++i) {
        Stored number;
        std::memcpy(&number, data.data() + i * sizeof number, sizeof number);
        values[i] = static_cast<float>(number);
        if (!std::isfinite(values[i]))
            refuse_array(path, fmt::format("value {} is not finite", i), "Remove NaN and infinity.");
    }
    return values;
}

template <class T>
void write_array(std::string const& path, std::span<T const> values, std::span<std::size_t const> shape,
                 std::string_view descr) {
    std::size_t count = 1;
    for (std::size_t const size : shape) count *= size;
    assert(count == values.size());
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", descr,
                                     fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
    std::size_t const before = magic.size() + 4;   // magic, two version bytes, two length bytes
    header.append(data_alignment - 1 - (before + header.size()) % data_alignment, ' ');
    header += '\n';
    std::string file{magic};
    file += '\x01';
    file += '\x00';
    file += static_cast<char>(header.size() & 0xff);
    file += static_cast<char>(header.size() >> 8);
    file += header;
    file.append(reinterpret_cast<char const*>(values.data()), values.size_bytes());
    write_file_atomically(path, std::string_view{file});
}

}   // namespace

NpyArray read_npy(std::string const& path) {
    std::vector<std::byte> const file = read_file(path);
    std::string_view const text{reinterpret_cast<char const*>(file.data()), file.size()};
    if (!text.starts_with(magic)) refuse_array(path, "it is not an NPY file", "Check the path.");
    if (text.size() < magic.size() + 4) refuse_array(path, "the file was cut inside its header");
    auto const byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(text[at])); };
    std::size_t const version = byte(6);
    if (version != 1 && version != 2)
        refuse_array(path, fmt::format("NPY version {}, this program reads 1 and 2", version));
    std::size_t const start = version == 1 ? 10 : 12;
    if (text.size() < start) refuse_array(path, "the file was cut inside its header");
    std::size_t length = byte(8) | byte(9) << 8;
    if (version == 2) length |= byte(10) << 16 | byte(11) << 24;
    if (length > text.size() - start) refuse_array(path, "the file was cut inside its header");

    auto header = HeaderReader{text.substr(start, length)}.read();
    if (!header) refuse_array(path, "its header cannot be understood");
    bool const is_double = header->descr == "<f8", is_count = header->descr == "<u4";
    if (!is_double && !is_count && header->descr != "<f4")
        refuse_array(path, fmt::format("its values are '{}', not '<f4', '<f8' or '<u4'", header->descr),
                     "Convert them with astype('float32').");
    if (header->fortran_order)
        refuse_array(path, "its values are in Fortran order", "Save numpy.ascontiguousarray(...).");
    auto const data = std::span{file}.subspan(start + length);
    std::size_t const value_size = is_double ? 8 : 4;
    std::size_t count = 1;
    for (std::size_t const size : header->shape) {
        if (size != 0 && count > data.size() / size)
            refuse_array(path, "the file was cut: its shape needs more values");
        count *= size;
    }
    if (count * value_size != data.size())
        refuse_array(path, fmt::format("{} bytes of values, its shape ({}) needs {}", data.size(),
                                       fmt::join(header->shape, ", "), count * value_size));
    return {std::move(header->shape), is_double  ? values_of<double>(data, path)
                                      : is_count ? values_of<std::uint32_t>(data, path)
                                                 : values_of<float>(data, path)};
}

void write_npy(std::string const& path, std::span<float const> values, std::span<std::size_t const> shape) {
    write_array(path, values, shape, "<f4");
}
void write_npy(std::string const& path, std::span<double const> values, std::span<std::size_t const> shape) {
    write_array(path, values, shape, "<f8");
}
void write_npy(std::string const& path, std::span<std::uint32_t const> values, std::span<std::size_t const> shape) {
    write_array(path, values, shape, "<u4");
}

}   // namespace lore
