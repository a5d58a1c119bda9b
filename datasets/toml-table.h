// One table of a TOML file, with what is needed to say where something in it is wrong.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::datasets {

/// Throws kUsage with "file:line:column: what is wrong".
toml::table parseToml(const std::string& file, std::string_view text);

/// Throws kUsage with "file:line:column: key: what would be right". `file` and `table` have to outlive it.
class TomlTable {
 public:
  struct Entry {
    const toml::key& key;
    const toml::node& node;
  };

  /// `name` is the table's in messages; a key that is not in `keys` is refused. `path` goes before keys in messages,
  /// e.g. "axes.".
  TomlTable(const std::string& file, const toml::table& table, std::string_view name,
            std::initializer_list<std::string_view> keys, std::string path = {});
  /// A table whose keys are the file's to choose.
  TomlTable(const std::string& file, const toml::table& table, std::string path)
      : file_(file), table_(table), path_(std::move(path)) {}

  const toml::table& table() const { return table_; }
  const std::string& file() const { return file_; }
  const std::string& path() const { return path_; }
  bool has(std::string_view key) const { return table_.contains(key); }
  const toml::node* find(std::string_view key) const { return table_.get(key); }
  const toml::node& need(std::string_view key, std::string_view what) const;
  /// In the file's order, which toml++ does not keep.
  std::vector<Entry> entries() const;

  [[noreturn]] void fail(const toml::source_region& where, std::string_view wrong) const;
  /// "path.key: wrong", at the node, which may be one inside the key's value.
  [[noreturn]] void refuse(std::string_view key, const toml::node& node, std::string_view wrong) const;
  [[noreturn]] void refuseKey(const toml::key& key, std::string_view wrong) const;  ///< the same, at the key

  // Each is nothing where the key is not there, and refuses a value of another kind.
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count) const;  ///< finite
  std::optional<double> number(std::string_view key) const;                                   ///< finite
  std::optional<std::int64_t> whole(std::string_view key, std::int64_t least, std::int64_t most) const;
  std::optional<std::string> line(std::string_view key) const;  ///< text, not empty, without a line's end
  /// An array with something in it, or nothing where the key is not there; `what` says what would be right.
  const toml::array* list(std::string_view key, std::string_view what) const;

 private:
  const std::string& file_;
  const toml::table& table_;
  std::string path_;
};

}  // namespace tessera::datasets
