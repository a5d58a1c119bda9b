// What the shells need of their own: how they hand over the words, and how they take the answer. The rest is
// `tessera complete`.
#include <tessera/error.h>

#include <array>
#include <utility>

#include "host/cli/completion.h"
#include "host/support/suggest.h"

namespace tessera::cli {
namespace {

// Bash breaks words at = and :, so the words are made from the line; of a candidate it wants what follows the last
// break.
constexpr const char* kBash = R"(# tessera: completion for bash.  source <(tessera completion bash)
_tessera() {
  local program=${COMP_WORDS[0]/#\~/$HOME} line=${COMP_LINE:0:COMP_POINT} words word candidate meaning cut quote=
  read -ra words <<<"$line"
  [[ $line == *[[:space:]] ]] && words+=('')
  word=${words[-1]}
  # Inside quotes bash breaks nothing.
  if [[ $word == [\"\']* ]]; then quote=1 word=${word:1} words[-1]=${word}; fi
  cut=
  [[ $quote ]] || case $COMP_WORDBREAKS in *[=:]*) cut=${word%"${word##*[=:]}"} ;; esac
  COMPREPLY=()
  while IFS=$'\t' read -r candidate meaning; do
    case $candidate in
      :files* | :folders*)
        local action=-f before=
        [[ $candidate == :folders* ]] && action=-d
        [[ $candidate == *' '* ]] && before=${candidate#* }
        compopt -o filenames 2>/dev/null
        while IFS= read -r candidate; do
          candidate=$before$candidate
          COMPREPLY+=("${candidate#"$cut"}")
        done < <(compgen $action -- "${word#"$before"}") ;;
      *)
        [[ $candidate == *[=:] ]] && compopt -o nospace 2>/dev/null
        COMPREPLY+=("${candidate#"$cut"}") ;;
    esac
  done < <("$program" complete -- "${words[@]:1}" 2>/dev/null)
}
complete -F _tessera tessera
)";

constexpr const char* kZsh = R"(#compdef tessera
# tessera: completion for zsh.  source <(tessera completion zsh), or this file as _tessera in a folder of $fpath
_tessera() {
  local line candidate meaning before
  local -a with without texts
  while IFS= read -r line; do
    candidate=${line%%$'\t'*} meaning=${line#*$'\t'}
    case $candidate in
      :files*|:folders*)
        before=
        [[ $candidate == *' '* ]] && before=${candidate#* }
        compset -P "${(b)before}"
        if [[ $candidate == :folders* ]]; then _files -/; else _files; fi ;;
      *[=:]) without+=("$candidate") ;;
      *) with+=("$candidate") texts+=("$candidate${meaning:+  -- $meaning}") ;;
    esac
  done < <(${(Q)words[1]/#\~/$HOME} complete -- "${(@Q)words[2,CURRENT]}" 2>/dev/null)
  (( $#without )) && compadd -S '' -a without
  (( $#with )) && compadd -l -d texts -a with
  return 0
}
if [[ $funcstack[1] == _tessera ]]; then _tessera "$@"; else compdef _tessera tessera; fi
)";

constexpr const char* kFish = R"(# tessera: completion for fish.  tessera completion fish | source
function __tessera_complete
    set -l words (commandline -opc)
    set -l word (commandline -ct)
    for line in ($words[1] complete -- $words[2..] "$word" 2>/dev/null)
        if string match -qr '^:(files|folders)' -- $line
            set -l before (string replace -r '^:\w+ ?' '' -- (string split \t -- $line)[1])
            set -l rest (string sub -s (math (string length -- "$before") + 1) -- "$word")
            set -l names __fish_complete_path
            string match -q ':folders*' -- $line; and set names __fish_complete_directories
            for name in ($names "$rest")
                echo $before$name
            end
        else
            echo $line
        end
    end
end
complete -c tessera -f -a '(__tessera_complete)'
)";

}  // namespace

std::string completionScript(const std::string& shell) {
  static const std::array<std::pair<const char*, const char*>, 3> scripts{
      {{"bash", kBash}, {"zsh", kZsh}, {"fish", kFish}}};
  for (const auto& [name, script] : scripts)
    if (name == shell) return script;
  failUsage("completion " + shell + ": no such shell; " + support::whatThereIs(shell, {"bash", "zsh", "fish"}));
}

}  // namespace tessera::cli
