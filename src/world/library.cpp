#include <lore/world/library.h>

#include "foreign_call.h"
#include "foreign_world.h"
#include "refusal.h"

#include <lore/core/error.h>

#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

namespace lore {

namespace {

static_assert(LORE_MOST_SENSORS == most_sensors && LORE_MOST_EFFECTORS == most_effectors &&
              LORE_MOST_OUTCOMES == most_outcomes && LORE_MOST_LIVES == most_lives &&
              LORE_LONGEST_NAME == longest_name && LORE_LARGEST_SIZE == largest_world &&
              LORE_LONGEST_SCENE == longest_scene);

/// Reads no further than one byte beyond `longest`, so that why_invalid says that it is too long.
std::string text_of(char const* text, std::size_t longest) {
    return text == nullptr ? std::string{} : std::string(text, ::strnlen(text, longest + 1));
}

std::string missing_function(lore_world_v1 const& calls) {
    if (calls.open == nullptr) return "open";
    if (calls.facts == nullptr) return "facts";
    if (calls.begin == nullptr) return "begin";
    if (calls.sense == nullptr) return "sense";
    if (calls.act == nullptr) return "act";
    if (calls.outcome == nullptr) return "outcome";
    if (calls.end == nullptr) return "end";
    if (calls.close == nullptr) return "close";
    return "";
}

std::string why_uncountable(char const* name, int count, int most, lore_channel const* channels) {
    if (count < 1 || count > most)
        return fmt::format("its {}_count is {}, which is outside 1 .. {}", name, count, most);
    if (channels == nullptr) return fmt::format("its {}s are NULL", name);
    for (int c = 0; c < count; ++c)
        if (channels[c].binary != 0 && channels[c].binary != 1)
            return fmt::format("binary of {} {} is {}, and is 0 or 1", name, c, channels[c].binary);
    return "";
}

std::vector<ChannelInfo> copy_of(lore_channel const* channels, int count) {
    std::vector<ChannelInfo> copy;
    for (int c = 0; c < count; ++c) copy.push_back({text_of(channels[c].name, longest_name), channels[c].binary == 1});
    return copy;
}

/// The facts, once they are sure to be whole and right. Throws Error.
WorldFacts checked_facts(lore_facts const* told, std::string const& called) {
    constexpr std::string_view remedy = "Mend it; lore/world.h has the rules.";
    if (told == nullptr) refuse_world(called, "its function facts gave NULL", remedy);
    for (std::string const& why : {why_uncountable("sensor", told->sensor_count, most_sensors, told->sensors),
                                   why_uncountable("effector", told->effector_count, most_effectors, told->effectors)})
        if (!why.empty()) refuse_world(called, why, remedy);
    WorldFacts facts;
    facts.name = text_of(told->name, longest_name);
    facts.task = text_of(told->task, longest_name);
    facts.reward_unit = text_of(told->reward_unit, longest_name);
    facts.sensors = copy_of(told->sensors, told->sensor_count);
    facts.effectors = copy_of(told->effectors, told->effector_count);
    facts.outcome_size = told->outcome_size;
    facts.max_batch = told->max_batch;
    facts.width = told->width;
    facts.height = told->height;
    if (std::string const why = why_invalid(facts); !why.empty()) refuse_world(called, why, remedy);
    return facts;
}

}   // namespace

WorldLibrary::WorldLibrary(std::string const& file) : file_(file) {
    // Without a '/' the system would look for it in places of its own.
    std::string const path = file.find('/') == std::string::npos ? "./" + file : file;
    ForeignCall::watch_signals();
    {
        ForeignCall const call{file_.c_str(), "of initialization"};
        handle_ = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    }
    std::string const called = fmt::format("world {}", file);
    if (handle_ == nullptr) {
        char const* const why = ::dlerror();
        refuse_world(called, why == nullptr ? "it cannot be loaded" : why,
                     "Compile it as a shared library for this machine (cc -shared -fPIC).");
    }
    auto const entry = reinterpret_cast<lore_world_v1 const* (*)()>(::dlsym(handle_, "lore_world"));
    auto const give_up = [&](std::string const& why, std::string const& remedy) {
        ::dlclose(handle_);
        refuse_world(called, why, remedy);
    };
    if (entry == nullptr)
        give_up("it exports no function lore_world", "Define it as lore/world.h says, in C++ as extern \"C\".");
    {
        ForeignCall const call{file_.c_str(), "lore_world"};
        calls_ = entry();
    }
    if (calls_ == nullptr) give_up("its function lore_world gave NULL", "Let it return the struct of its functions.");
    if (calls_->version != LORE_WORLD_VERSION)
        give_up(fmt::format("it is of version {} of lore/world.h, and this Lore reads version {}", calls_->version,
                            LORE_WORLD_VERSION),
                "Compile it again with the header of this Lore.");
    if (std::string const name = missing_function(*calls_); !name.empty())
        give_up(fmt::format("its function {} is NULL", name), "Only scene_svg may be.");
}

WorldLibrary::~WorldLibrary() { ::dlclose(handle_); }

ForeignWorld::ForeignWorld(std::unique_ptr<WorldLibrary const> library, std::string const& settings)
    : library_(std::move(library)), called_(fmt::format("world {}", library_->file())) {
    std::array<char, 512> error{};
    {
        ForeignCall const call{called_.c_str(), "open"};
        world_ = calls().open(settings.c_str(), error.data(), static_cast<int>(error.size()));
    }
    error.back() = '\0';
    if (world_ == nullptr) refuse_settings(called_, error.data());
    // From here on, what fails must close the world: the destructor does not run for half an object.
    struct Closer {
        ForeignWorld* world;
        ~Closer() {
            if (world != nullptr) world->calls().close(std::exchange(world->world_, nullptr));
        }
    } closer{this};
    {
        ForeignCall const call{called_.c_str(), "facts or scene_svg"};
        facts_ = checked_facts(calls().facts(world_), called_);
        char const* const scene = calls().scene_svg == nullptr ? nullptr : calls().scene_svg(world_);
        scene_ = text_of(scene, longest_scene);
    }
    if (scene_.size() > longest_scene)
        refuse_world(called_, fmt::format("its scene has more than {} bytes", longest_scene), "Draw less.");
    called_ = fmt::format("{} from {}", title(facts_), library_->file());
    closer.world = nullptr;
}

void limit_world_calls(int seconds) { ForeignCall::watch_time(seconds); }

std::unique_ptr<World> load_world(std::string const& file, std::string const& settings) {
    return std::make_unique<ForeignWorld>(std::make_unique<WorldLibrary const>(file), settings);
}

}   // namespace lore
