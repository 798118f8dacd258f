#include <lore/core/growing_bytes.h>

#include <cerrno>
#include <cstdlib>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace lore {

namespace {

constexpr std::size_t written_at_once = std::size_t{1} << 20;

}   // namespace

GrowingBytes::GrowingBytes(std::string const& folder) : path_("a file without a name in " + folder) {
    std::string name = folder + "/.lore-tmp-XXXXXX";   // for a moment
    file_ = FileDescriptor{::mkostemp(name.data(), O_CLOEXEC)};
    if (file_.get() < 0) throw file_error("make", path_, errno);
    ::unlink(name.c_str());
}

void GrowingBytes::add(std::span<std::byte const> bytes) {
    last_.insert(last_.end(), bytes.begin(), bytes.end());
    if (!in_memory() && last_.size() >= written_at_once) write_last();
}

void GrowingBytes::write_last() {
    write_fully(file_.get(), last_, path_);
    written_ += last_.size();
    last_.clear();
}

std::byte const* GrowingBytes::read(std::uint64_t at, std::size_t size, std::byte* copy) const {
    if (at >= written_) return last_.data() + (at - written_);
    for (std::size_t read = 0; read < size;) {
        ssize_t const done = ::pread(file_.get(), copy + read, size - read, static_cast<off_t>(at + read));
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) throw file_error("read", path_, done < 0 ? errno : EIO);
        read += static_cast<std::size_t>(done);
    }
    return copy;
}

GrowingBytes::Whole GrowingBytes::release() {
    if (in_memory()) {
        auto const kept = std::make_shared<std::vector<std::byte> const>(std::move(last_));
        return {*kept, kept};
    }
    write_last();
    if (written_ == 0) return {};
    auto const length = static_cast<std::size_t>(written_);
    void* const mapped = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, file_.get(), 0);
    if (mapped == MAP_FAILED) throw file_error("map", path_, errno);
    std::shared_ptr<void const> const kept{mapped, [length](void* place) { ::munmap(place, length); }};
    return {{static_cast<std::byte const*>(mapped), length}, kept};
}

}   // namespace lore
