# Completion of Lore's programs in bash: commands and options are those that --help shows, other words are file names.

_lore_commands() { "$@" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p'; }
_lore_options() { "$@" --help 2>/dev/null | sed -n 's/^  \(-[a-zA-Z],\)\{0,1\}\(--[a-z-]*\).*/\2/p'; }

_lore() {
  local current=$2 first=1 commands="" words=""
  local -a program=("$1")
  if [[ ${1##*/} == lore ]]; then
    program=("lore-${COMP_WORDS[1]}") first=2
  fi
  if ((COMP_CWORD < first)) || [[ ${COMP_WORDS[1]} == help && ${1##*/} == lore ]]; then
    words="help $(lore 2>/dev/null | sed -n 's/^  lore \([a-z]*\)  .*/\1/p')"
  else
    commands=$(_lore_commands "${program[@]}")
    # A command's options come after its name.
    if ((COMP_CWORD > first)) && [[ -n $commands ]]; then program+=("${COMP_WORDS[first]}"); fi
    case $current in
      -*) words=$(_lore_options "${program[@]}") ;;
      *) if ((COMP_CWORD == first)); then words=$commands; fi ;;
    esac
  fi
  if [[ -n $words ]]; then mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  else mapfile -t COMPREPLY < <(compgen -f -- "$current"); fi
}

complete -o filenames -F _lore lore lore-evolve lore-kb lore-replay lore-campaign lore-world
