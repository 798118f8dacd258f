# The scripts of replays, for the pages of report and watch: LORE_WORLD_REPLAY_JS plays any world, LORE_ARENA_REPLAY_JS
# an arena, whose colors LORE_ARENA_SIGNS tells. Both begin and end alike.
set(figure ${CMAKE_CURRENT_LIST_DIR})
set(arena_view ${CMAKE_CURRENT_LIST_DIR}/../arena_view)
file(READ ${figure}/replay_begin.js LORE_REPLAY_BEGIN)
file(READ ${figure}/replay_end.js LORE_REPLAY_END)
file(READ ${figure}/world_replay.js LORE_WORLD_REPLAY_JS)
file(READ ${arena_view}/replay.js LORE_ARENA_REPLAY_JS)
file(READ ${arena_view}/signs.txt LORE_ARENA_SIGNS)
foreach(part LORE_REPLAY_BEGIN LORE_REPLAY_END)
  string(REGEX REPLACE "\n$" "" ${part} "${${part}}")   # the place ends its line by itself
endforeach()
foreach(script LORE_WORLD_REPLAY_JS LORE_ARENA_REPLAY_JS)
  foreach(part LORE_REPLAY_BEGIN LORE_REPLAY_END)
    string(REPLACE "@${part}@" "${${part}}" ${script} "${${script}}")
  endforeach()
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${figure}/replay_begin.js ${figure}/replay_end.js
  ${figure}/world_replay.js ${arena_view}/replay.js ${arena_view}/signs.txt)
