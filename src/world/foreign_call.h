#pragma once

namespace lore {

/// While one lives, the code of a world's library runs. A fatal signal then prints a line that names the world and the
/// function, and takes its course: the handler that was there before, or the end of the program.
///
/// Costs three stores. One thread at a time, as the whole interface.
class ForeignCall {
public:
    /// Both texts outlive the object.
    ForeignCall(char const* world, char const* function) {
        world_ = world;
        function_ = function;
        number_ = number_ + 1;
    }
    ForeignCall(ForeignCall const&) = delete;
    ForeignCall& operator=(ForeignCall const&) = delete;
    ~ForeignCall() { function_ = nullptr; }

    /// Installs the handlers of fatal signals, once a process.
    static void watch_signals();
    /// As limit_world_calls (library.h).
    static void watch_time(int seconds);

private:
    static void tell_crash(int signal);
    static void tell_delay(int signal);

    static char const* volatile world_;
    static char const* volatile function_;   ///< null: Lore's own code runs
    static unsigned long volatile number_;   ///< of calls begun
};

}   // namespace lore
