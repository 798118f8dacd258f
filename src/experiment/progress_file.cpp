#include <lore/experiment/progress_file.h>

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>
#include <lore/evolution/summary.h>

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lore {

namespace {

constexpr std::string_view header =
    "generation,best_balls,mean_balls,distance,mean_diversity,best_shaping,mean_connections,mean_hidden,fronts,tied,"
    "shaping_at_max,evaluations,steps,seconds";

/// Takes the fields of one line one after the other; false as soon as one is not what it should be.
class Fields {
public:
    explicit Fields(std::string_view line) : rest_(line) {}

    template <class Number>
    bool take(Number& number) {
        std::string_view const field = next();
        auto const [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
        return error == std::errc{} && end == field.data() + field.size() &&
               std::isfinite(static_cast<double>(number));   // "nan" is a number to it
    }
    bool take(DistanceKind& kind) {
        try {
            kind = distance_kind(next());
            return true;
        } catch (UsageError const&) { return false; }
    }
    bool at_end() const { return ended_; }

private:
    std::string_view next() {
        std::size_t const comma = rest_.find(',');
        std::string_view const field = rest_.substr(0, comma);
        ended_ = comma == std::string_view::npos;
        rest_.remove_prefix(ended_ ? rest_.size() : comma + 1);
        return field;
    }
    std::string_view rest_;
    bool ended_ = false;
};

[[noreturn]] void refuse(std::string const& path, std::string const& reason, std::string_view remedy) {
    throw Error(fmt::format("cannot read {}", path), reason, remedy);
}

Error write_error(std::string const& path) {
    return Error(fmt::format("cannot write {}", path), std::strerror(errno), "Mend that and resume the run.");
}

}   // namespace

std::string progress_header() { return std::string{header}; }

std::string text(ProgressRow const& row) {
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{:.3f}", row.generation, row.best_balls, row.mean_balls,
                       name(row.distance), row.mean_diversity, row.best_shaping, row.mean_connections, row.mean_hidden,
                       row.fronts, row.tied, row.shaping_at_max, row.evaluations, row.steps, row.seconds);
}

std::vector<ProgressRow> read_progress(std::string const& path) {
    auto const bytes = read_file(path);
    std::string_view rest{reinterpret_cast<char const*>(bytes.data()), bytes.size()};
    std::vector<ProgressRow> rows;
    for (int line_number = 1;; ++line_number) {
        std::size_t const end = rest.find('\n');
        if (end == std::string_view::npos) {
            if (line_number == 1) refuse(path, "there is no header", "Take a copy that is whole.");
            return rows;
        }
        std::string_view const line = rest.substr(0, end);
        rest.remove_prefix(end + 1);
        if (line_number == 1) {
            if (line != header) refuse(path, "its columns are not those of progress.csv", "Check the path.");
            continue;
        }
        Fields fields{line};
        ProgressRow row;
        bool const whole = fields.take(row.generation) && fields.take(row.best_balls) && fields.take(row.mean_balls) &&
                           fields.take(row.distance) && fields.take(row.mean_diversity) &&
                           fields.take(row.best_shaping) && fields.take(row.mean_connections) &&
                           fields.take(row.mean_hidden) && fields.take(row.fronts) && fields.take(row.tied) &&
                           fields.take(row.shaping_at_max) && fields.take(row.evaluations) && fields.take(row.steps) &&
                           fields.take(row.seconds) && fields.at_end();
        if (!whole || row.generation != static_cast<int>(rows.size()))
            refuse(path, fmt::format("line {} is damaged", line_number), "Take a copy that is whole.");
        rows.push_back(row);
    }
}

ProgressRow row_of(GenerationReport const& report) {
    GenerationSummary const summary = summarize(report);
    ProgressRow row;
    row.generation = summary.generation;
    row.best_balls = summary.best_balls;
    row.mean_balls = summary.mean_balls;
    row.distance = summary.distance;
    row.mean_diversity = summary.mean_diversity;
    row.best_shaping = summary.best_shaping;
    row.mean_connections = summary.mean_connections;
    row.mean_hidden = summary.mean_hidden;
    row.fronts = summary.fronts;
    row.tied = summary.tied;
    row.shaping_at_max = summary.shaping_at_max;
    row.evaluations = static_cast<std::uint64_t>(summary.evaluations);
    row.steps = static_cast<std::uint64_t>(summary.steps);
    return row;
}

ProgressWriter::ProgressWriter(std::string path, std::uint64_t bytes) : path_(std::move(path)) {
    bool const fresh = bytes == 0;
    if (!fresh) {
        struct stat status {};
        if (::stat(path_.c_str(), &status) != 0 || static_cast<std::uint64_t>(status.st_size) < bytes)
            throw Error(fmt::format("cannot go on with {}", path_),
                        fmt::format("it is shorter than the {} bytes that the checkpoint knows", bytes),
                        "Take a copy that is whole, or start the run anew in another directory.");
    }
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (fresh ? O_TRUNC : 0), 0666);
    if (file_ < 0) throw write_error(path_);
    if (!fresh && (::ftruncate(file_, static_cast<off_t>(bytes)) != 0 || ::lseek(file_, 0, SEEK_END) < 0))
        throw write_error(path_);
    bytes_ = bytes;
    if (fresh) write(progress_header() + "\n");
}

ProgressWriter::~ProgressWriter() {
    if (file_ >= 0) ::close(file_);
}

void ProgressWriter::write(std::string_view line) {
    while (!line.empty()) {
        ssize_t const written = ::write(file_, line.data(), line.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw write_error(path_);
        bytes_ += static_cast<std::uint64_t>(written);
        line.remove_prefix(static_cast<std::size_t>(written));
    }
}

void ProgressWriter::add(ProgressRow const& row) { write(text(row) + "\n"); }

std::uint64_t ProgressWriter::sync() {
    if (::fsync(file_) != 0 && errno != EINVAL) throw write_error(path_);
    return bytes_;
}

}   // namespace lore
