#pragma once

#include <lore/world.h>
#include <lore/world/world.h>

#include <memory>
#include <string>

namespace lore {

/// A shared library that is loaded, and its interface, complete. Unloads it at the end.
class WorldLibrary {
public:
    /// Throws Error as load_world.
    explicit WorldLibrary(std::string const& file);
    WorldLibrary(WorldLibrary const&) = delete;
    WorldLibrary& operator=(WorldLibrary const&) = delete;
    ~WorldLibrary();

    lore_world_v1 const& calls() const { return *calls_; }
    std::string const& file() const { return file_; }

private:
    std::string file_;
    void* handle_;
    lore_world_v1 const* calls_ = nullptr;
};

/// A world behind the C interface (library.h).
class ForeignWorld final : public World {
public:
    /// Throws UsageError and Error as load_world.
    ForeignWorld(std::unique_ptr<WorldLibrary const>, std::string const& settings);
    ForeignWorld(ForeignWorld const&) = delete;
    ForeignWorld& operator=(ForeignWorld const&) = delete;
    ~ForeignWorld() override;

    WorldFacts const& facts() const override { return facts_; }
    std::unique_ptr<Life> begin() const override;
    std::unique_ptr<Lives> begin_lives(int count) const override;
    std::string scene_svg() const override { return scene_; }

    lore_world_v1 const& calls() const { return library_->calls(); }
    void const* get() const { return world_; }
    /// "world pendulum short from ./pendulum.so", as errors call it.
    std::string const& called() const { return called_; }

private:
    std::unique_ptr<WorldLibrary const> library_;
    std::string called_;
    void* world_ = nullptr;
    WorldFacts facts_;
    std::string scene_;
};

}   // namespace lore
