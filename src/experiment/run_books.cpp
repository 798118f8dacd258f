#include "run_books.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/lineage_file.h>
#include <lore/core/isa.h>
#include <lore/experiment/run_directory.h>

#include <filesystem>
#include <utility>

namespace lore {

namespace {

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

/// Gives both checkpoints a digest of the present kind, before this version writes the run's config.toml anew. A former
/// digest is taken over the text of config.toml and would no longer fit; with both renewed, the run can be killed at
/// any time.
void renew_digest(RunSetup const& setup) {
    Checkpoint renewed = *setup.checkpoint;
    renewed.config_digest = setup.digest;
    for (int copy = 0; copy < 2; ++copy)
        write_checkpoint(setup.file(run_file::checkpoint), setup.file(run_file::older_checkpoint), renewed);
}

}   // namespace

RunBooks::RunBooks(RunSetup setup, std::vector<std::string> hosts, std::string command_line, double nothing_shown)
    : setup_(std::move(setup)), nothing_shown_(nothing_shown) {
    Checkpoint const* const from = setup_.checkpoint ? &*setup_.checkpoint : nullptr;
    // What a run has so far is opened first: where that fails, its manifest still says what it should be.
    if (from) open_outputs(from);
    if (setup_.has_former_digest) renew_digest(setup_);
    // The configuration comes last: a directory holds a run as soon as it has one, and then has all that it needs.
    ExperimentConfig kept = setup_.order.config;
    if (!kept.has_world()) {
        kept.arena = run_file::arena;
        write_file_atomically(setup_.file(run_file::arena), std::string_view{setup_.order.arena_text});
    }
    RunSession session;
    session.command_line = std::move(command_line);
    session.started = time_stamp();
    session.first_generation = from ? from->state.population.generation + 1 : 0;
    session.last_generation = from ? from->state.population.generation : 0;
    session.ranks = static_cast<int>(hosts.size());
    session.hosts = std::move(hosts);
    session.isa = name(active_isa());
    setup_.manifest.sessions.push_back(std::move(session));
    setup_.manifest.status = RunStatus::running;
    setup_.manifest.outputs.clear();   // they grow from here on
    write_manifest_now();
    write_file_atomically(setup_.file(run_file::config), std::string_view{to_toml(kept)});

    if (!from) open_outputs(nullptr);
    if (from) {
        former_seconds_ = from->seconds;
        row_.evaluations = from->evaluations;
        row_.steps = former_steps_ = from->steps;
        last_checkpoint_generation_ = from->state.population.generation;
    }
    setup_.checkpoint.reset();   // its population would stay in memory for the whole run
}

void RunBooks::open_outputs(Checkpoint const* from) {
    progress_.emplace(setup_.file(run_file::progress), from ? from->progress_bytes : 0, reward_unit());
    if (!setup_.archive_all) return;
    if (from) all_.emplace(setup_.file(run_file::all_individuals), from->all_individuals, from->state.population);
    else all_.emplace(setup_.file(run_file::all_individuals), setup_.manifest.world);
}

double RunBooks::session_seconds() const { return seconds_between(began_, Clock::now()); }

GenerationSummary const& RunBooks::add(GenerationReport const& report) {
    auto const before = Clock::now();
    GenerationSummary row = summarize(report, nothing_shown_);
    row.evaluations += row_.evaluations;
    row.steps += row_.steps;
    row.seconds = former_seconds_ + session_seconds();
    row_ = row;
    progress_->add(row_);
    if (all_) all_->add(report);
    filing_seconds_ += seconds_between(before, Clock::now());
    return row_;
}

bool RunBooks::checkpoint_is_due() const {
    return row_.generation - last_checkpoint_generation_ >= setup_.order.config.checkpoint_generations ||
           seconds_between(last_checkpoint_, Clock::now()) >= 60 * setup_.order.config.checkpoint_minutes;
}

void RunBooks::write_checkpoint(EvolutionState const& state) {
    auto const before = Clock::now();
    Checkpoint checkpoint;
    checkpoint.state = state;
    checkpoint.world = setup_.manifest.world;
    checkpoint.seed = setup_.seed;
    checkpoint.config_digest = setup_.digest;
    checkpoint.evaluations = row_.evaluations;
    checkpoint.steps = row_.steps;
    checkpoint.seconds = former_seconds_ + session_seconds();
    checkpoint.progress_bytes = progress_->sync();
    if (all_) checkpoint.all_individuals = all_->mark();
    lore::write_checkpoint(setup_.file(run_file::checkpoint), setup_.file(run_file::older_checkpoint), checkpoint);
    last_checkpoint_generation_ = state.population.generation;
    last_checkpoint_ = Clock::now();
    filing_seconds_ += seconds_between(before, last_checkpoint_);
}

void RunBooks::write_manifest_now() { write_manifest(setup_.file(run_file::manifest), setup_.manifest); }

void RunBooks::close(EvolutionState const& state, RunStatus status, std::string const& reason) {
    if (last_checkpoint_generation_ != state.population.generation) write_checkpoint(state);
    write_lineage(setup_.file(run_file::lineage), state.population, setup_.manifest.world, setup_.founders_origin());
    if (all_ && status == RunStatus::done) all_->finish();

    Manifest& manifest = setup_.manifest;
    manifest.status = status;
    manifest.generation = state.population.generation;
    manifest.signature = state.signature.text();
    Individual const& best = best_of_run(state.population);
    manifest.best_reward = best.birth->reward;
    manifest.best = text(best.id());
    manifest.outputs.clear();
    for (std::string_view const output : {run_file::config, run_file::arena, run_file::progress, run_file::lineage,
                                          run_file::all_individuals, run_file::checkpoint})
        if (std::string const path = setup_.file(output); std::filesystem::exists(path))
            manifest.outputs.push_back(record_of(file_role::output, path, std::string{output}));
    RunSession& session = manifest.sessions.back();
    session.stopped = time_stamp();
    session.reason = reason;
    session.last_generation = manifest.generation;
    session.seconds = session_seconds();
    write_manifest_now();
}

}   // namespace lore
