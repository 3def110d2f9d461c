# Completion of portalens for bash: commands, their options as --help tells them, and files.
_portalens() {
  local word=${COMP_WORDS[COMP_CWORD]} command='' candidate
  local commands='render merge check trace image field draw help'
  for candidate in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ " $commands " == *" $candidate "* ]] && { command=$candidate; break; }
  done
  if [[ -z $command || $command == help ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands --help --version" -- "$word")
  elif [[ $word == -* ]]; then
    local options
    options=$("${COMP_WORDS[0]}" "$command" --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]*' | sort -u)
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  else
    compopt -o default
    COMPREPLY=()
  fi
}
complete -F _portalens portalens
