#include <lore/campaign/slurm.h>

#include <lore/archive/atomic_file.h>
#include <lore/campaign/state.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/input_file.h>
#include <lore/core/standard_streams.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>

namespace lore {

namespace {

namespace fs = std::filesystem;

/// 1,2,3,7 as "1-3,7".
std::string ranges(std::vector<int> const& numbers) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t last = i;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
        parts.push_back(last == i ? fmt::format("{}", numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[last]));
        i = last + 1;
    }
    return fmt::format("{}", fmt::join(parts, ","));
}

/// As sbatch reads it within quotes: every % as itself.
std::string as_pattern(std::string const& path) {
    std::string pattern;
    for (char const c : path) {
        if (c == '%') pattern += '%';
        if (c == '"' || c == '\\') pattern += '\\';
        pattern += c;
    }
    return pattern;
}

/// Runs a command and returns what it printed, to stderr too.
std::string output_of(std::vector<std::string> const& command) {
    std::string const line = shell_text(command) + " 2>&1";
    FILE* const pipe = ::popen(line.c_str(), "r");
    if (pipe == nullptr)
        throw Error(fmt::format("cannot start {}", command.front()), "no process could be made", "Try again.");
    std::string text;
    std::array<char, 4096> chunk;
    for (std::size_t got; (got = std::fread(chunk.data(), 1, chunk.size(), pipe)) > 0;) text.append(chunk.data(), got);
    int const status = ::pclose(pipe);
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw Error(fmt::format("{} failed", command.front()), text.empty() ? "it said nothing" : text,
                    WEXITSTATUS(status) == 127 ? "Call it where Slurm's programs are, or use 'lore-campaign run'."
                                               : "Mend that and submit again.");
    return text;
}

/// The id of a submitted job, "id" or "id;cluster". sbatch may say more, such as warnings of a site's plugins; that is
/// passed on.
std::string job_id(std::string const& said) {
    static std::regex const form{R"((\d+)(;.*)?)"};
    std::istringstream lines{said};
    std::string id;
    std::smatch parts;
    for (std::string line; std::getline(lines, line);)
        if (std::regex_match(line, parts, form)) id = parts[1];
        else write_stderr(line + "\n");
    if (id.empty())
        throw Error("cannot tell which job was submitted", fmt::format("sbatch printed no job id, but '{}'", said),
                    "Look at 'squeue --me', and cancel what is there.");
    return id;
}

/// Slurm's forms of a time: minutes, minutes:seconds, hours:minutes:seconds, days-hours, days-hours:minutes,
/// days-hours:minutes:seconds; or none at all.
std::optional<std::int64_t> seconds_of(std::string const& limit) {
    if (limit == "UNLIMITED" || limit == "INFINITE") return std::numeric_limits<std::int64_t>::max();
    static std::regex const form{R"((?:(\d{1,4})-)?(\d{1,9})(?::(\d{1,2}))?(?::(\d{1,2}))?)"};
    std::smatch parts;
    if (!std::regex_match(limit, parts, form)) return std::nullopt;
    auto const number = [&](std::size_t i) { return parts[i].matched ? std::stoll(parts[i].str()) : 0LL; };
    if (parts[1].matched) return ((number(1) * 24 + number(2)) * 60 + number(3)) * 60 + number(4);
    if (parts[4].matched) return (number(2) * 60 + number(3)) * 60 + number(4);
    return number(2) * 60 + number(3);
}

void check_times(ClusterPlan const& cluster) {
    auto const seconds = seconds_of(cluster.time_limit);
    if (!seconds)
        throw UsageError(fmt::format("cannot submit with a time limit of '{}'", cluster.time_limit), "it is no time",
                         "Write it like 04:00:00.");
    if (*seconds <= cluster.warning_seconds)
        throw UsageError(
            fmt::format("cannot submit with a time limit of {}", cluster.time_limit),
            fmt::format("tasks are told to stop {} s before it (cluster.warning_seconds)", cluster.warning_seconds),
            "Give them longer, or warn them later.");
}

std::string script_of(CampaignPlan const& plan, CampaignDirectory const& directory, Launcher const& launcher,
                      std::string const& program, BatchJob const& job) {
    std::string text = "#!/usr/bin/env bash\n";
    auto option = [&](std::string const& words) { text += fmt::format("#SBATCH {}\n", words); };
    option(fmt::format("--job-name=lore-{}", flat_name(job.group)));
    if (!job.tasks.empty()) option(fmt::format("--array={}%{}", ranges(job.tasks), plan.cluster.concurrent));
    option(fmt::format("--ntasks={}", launcher.ranks));
    option(fmt::format("--time={}", plan.cluster.time_limit));
    option(fmt::format("--signal=B:USR1@{}", plan.cluster.warning_seconds));
    option("--requeue");
    option("--open-mode=append");
    std::string const log = as_pattern(directory.file(fmt::format("logs/slurm-{}", flat_name(job.group))));
    option(fmt::format("--output=\"{}{}.out\"", log, job.tasks.empty() ? "" : "-%a"));
    for (std::string const& words : plan.cluster.options) option(words);
    text += "\n";

    std::vector<std::string> const campaign{plan.path, "--dir", directory.path()};
    if (job.group == "report")
        return text + fmt::format("exec {} report {}\n", shell_text({program}), shell_text(campaign));

    text += job.tasks.empty()
                ? fmt::format("step={}\nself=$SLURM_JOB_ID\n", shell_text({job.group}))
                : fmt::format("step=$(printf '{}/%03d' "
                              "\"$SLURM_ARRAY_TASK_ID\")\nself=${{SLURM_ARRAY_JOB_ID}}_${{SLURM_ARRAY_TASK_ID}}\n",
                              job.group);
    std::vector<std::string> options{"--jobs", "1", "--ranks", std::to_string(launcher.ranks)};
    if (launcher.ranks > 1) options.insert(options.end(), {"--launch", launcher.launch});
    if (!launcher.programs.empty())
        options.insert(options.end(), {"--programs", fs::absolute(launcher.programs).lexically_normal().string()});
    text += fmt::format("{} run {} {} --only \"$step\" &\n", shell_text({program}), shell_text(campaign),
                        shell_text(options));
    // The first wait ends when the warning comes; the run then still has to reach its checkpoint.
    text += "pid=$!\ntrap 'kill -USR1 $pid' USR1 TERM\nwait $pid; code=$?\nwhile kill -0 $pid 2>/dev/null; do wait "
            "$pid; code=$?; done\n"
            "# 75: stopped at a checkpoint, to be run again.\n"
            "if [ $code -eq 75 ]; then scontrol requeue \"$self\"; fi\nexit $code\n";
    return text;
}

}   // namespace

std::vector<BatchJob> batch_jobs(CampaignPlan const& given, CampaignDirectory const& where, Launcher const& launcher,
                                 std::string const& program) {
    CampaignPlan plan = given;
    plan.path = fs::absolute(given.path).lexically_normal().string();
    CampaignDirectory const directory{fs::absolute(where.path()).lexically_normal().string()};

    std::vector<BatchJob> jobs;
    std::map<std::string, std::size_t> job_of_group;
    for (Step const& step : steps_of(plan)) {
        if (state_of(plan, directory, step).status == StepStatus::done) continue;
        auto const [entry, is_new] = job_of_group.try_emplace(step.group, jobs.size());
        if (is_new) {
            BatchJob job;
            job.group = step.group;
            for (std::string const& group : step.after)
                if (job_of_group.contains(group))
                    (step.takes_what_is_there ? job.after_any : job.after).push_back(group);
            jobs.push_back(std::move(job));
        }
        if (step.kind == StepKind::evolve) jobs[entry->second].tasks.push_back(step.run);
    }
    BatchJob report;
    report.group = "report";
    for (BatchJob const& job : jobs) report.after_any.push_back(job.group);
    jobs.push_back(std::move(report));
    for (BatchJob& job : jobs) {
        job.script = directory.file(fmt::format("slurm/{}.sbatch", flat_name(job.group)));
        job.text = script_of(plan, directory, launcher, program, job);
    }
    return jobs;
}

std::vector<std::string> submit_campaign(CampaignPlan const& plan, CampaignDirectory const& directory,
                                         Launcher const& launcher, std::string const& program, bool only_write) {
    check_times(plan.cluster);
    std::string const record = directory.file("slurm/jobs.txt");
    if (!only_write && is_there(record)) {
        std::istringstream file{read_text(record)};
        std::vector<std::string> ids;
        for (std::string id, group; file >> id >> group;) ids.push_back(id);
        // squeue complains about ids that it has forgotten, so all of the user's jobs are asked for.
        std::istringstream queued{output_of({"squeue", "--me", "--noheader", "--format=%A %F"})};
        std::set<std::string> const waiting{std::istream_iterator<std::string>{queued}, {}};
        for (std::string const& id : ids)
            if (waiting.contains(id))
                throw Error(fmt::format("nothing was submitted for {}", directory.path()),
                            fmt::format("job {} of the last time is still queued", id),
                            "Wait for it, or cancel the jobs in slurm/jobs.txt with scancel.");
    }
    std::vector<BatchJob> const jobs = batch_jobs(plan, directory, launcher, program);
    for (char const* const folder : {"slurm", "logs"}) make_directory(directory.file(folder));
    std::map<std::string, std::string> id_of_group;
    std::vector<std::string> lines;
    std::string recorded;
    for (BatchJob const& job : jobs) {
        write_file_atomically(job.script, std::string_view{job.text});
        std::vector<std::string> conditions;
        auto const ids = [&](std::vector<std::string> const& groups) {
            std::vector<std::string> found;
            for (std::string const& group : groups)
                if (id_of_group.contains(group)) found.push_back(id_of_group.at(group));
            return found;
        };
        if (!job.after.empty()) conditions.push_back(fmt::format("afterok:{}", fmt::join(ids(job.after), ":")));
        if (!job.after_any.empty())
            conditions.push_back(fmt::format("afterany:{}", fmt::join(ids(job.after_any), ":")));
        if (only_write) {
            lines.push_back(job.script);
            continue;
        }
        std::vector<std::string> command{"sbatch", "--parsable"};
        // A dependency that can no longer be met ends the job instead of leaving it in the queue for ever.
        if (!conditions.empty())
            command.insert(command.end(),
                           {fmt::format("--dependency={}", fmt::join(conditions, ",")), "--kill-on-invalid-dep=yes"});
        command.push_back(job.script);
        std::string const id = job_id(output_of(command));
        id_of_group[job.group] = id;
        lines.push_back(fmt::format("{} {}{}", id, job.group,
                                    job.tasks.empty() ? "" : fmt::format(" ({} tasks)", job.tasks.size())));
        recorded += fmt::format("{} {}\n", id, job.group);
        write_file_atomically(record, std::string_view{recorded});
    }
    return lines;
}

}   // namespace lore
