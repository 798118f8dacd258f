#pragma once

namespace lore {

/// Between fork and exec, where it is safe: the other program is to begin with no signal blocked, ignored or handled.
void give_signals_back();

}   // namespace lore
