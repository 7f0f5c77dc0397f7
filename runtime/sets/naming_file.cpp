// This file reads naming conventions from JSON: the built-in table and files that extend it.
#include <algorithm>
#include <set>

#include "core/contains.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/plain_text.hpp"
#include "remap/surface.hpp"
#include "sets/naming.hpp"

namespace remap {

// This is the text of naming.json, compiled in so that no file is needed at run time (naming_text.cpp.in).
extern const std::string_view kNamingText;

namespace {

// Refuses unknown fields, because otherwise nobody would notice a typing error in the name of an optional
// field.
void refuse_unknown_fields(const Field& field, const std::vector<std::string>& known) {
  field.require(field.json().fields() != nullptr, "an object");
  for (const auto& [key, value] : *field.json().fields())
    if (!contains(known, key)) field.fail("unknown field '" + key + "'" + suggestion(key, known));
}

// Returns the value that the text names. Messages call the value `noun`.
template <typename Value, std::size_t Count>
Value read_named(const Field& field, const NamedValues<Value, Count>& table, const std::string& noun) {
  const std::string text = field.text();
  if (const auto value = value_named(table, text)) return *value;
  field.fail("unknown " + noun + " '" + text + "'" + suggestion(text, names_of(table)));
}

ChannelMeaning read_meaning(Channels channels, const Field& field) {
  const auto input = parameter_named(field.text());
  if (input && is_input(*input) && !value_named(kRoles, field.text())) return {channels, Role::kOther, input};
  return {channels, read_named(field, kRoles, "role")};
}

// Refuses a rule with two channels for roughness or for specular, because a converter reads one of each.
void refuse_doubles(const Field& field, const std::vector<ChannelMeaning>& meaning) {
  const auto width = [](const ChannelMeaning& entry) { return is_roughness(entry.role); };
  const auto specular = [](const ChannelMeaning& entry) { return entry.role == Role::kSpecular; };
  field.require(std::count_if(meaning.begin(), meaning.end(), width) <= 1,
                "at most one of roughness, glossiness and alpha_width");
  field.require(std::count_if(meaning.begin(), meaning.end(), specular) <= 1, "specular at most once");
}

std::vector<ChannelMeaning> read_channels(const Field& field) {
  field.require(field.json().fields() != nullptr && !field.json().empty(),
                "an object of channels and their roles");
  std::vector<std::string> known = names_of(kChannels);
  known.erase(known.begin());  // drops the name of the whole map
  refuse_unknown_fields(field, known);
  const bool color = field.contains("RGB");
  field.require(!color || (!field.contains("R") && !field.contains("G") && !field.contains("B")),
                "RGB or its channels one by one");
  std::vector<ChannelMeaning> meaning;
  for (const auto& [channels, name] : kChannels)
    if (const std::string key(name); field.contains(key))
      meaning.push_back(read_meaning(channels, field[key]));
  refuse_doubles(field, meaning);
  return meaning;
}

std::string read_word(const Field& field) {
  const std::string word = field.text();
  field.require(!word_key(word).empty(), "a word");
  field.require(!is_resolution(word) && !is_format_word(word),
                "a word that is neither a resolution nor a format, which are skipped in every name");
  return word;
}

NamingRule read_rule(const Field& field) {
  refuse_unknown_fields(field, {"words", "ordinary", "role", "channels"});
  field.require(field.contains("role") != field.contains("channels"), "either \"role\" or \"channels\"");
  NamingRule rule;
  rule.words = field["words"].list(1, read_word);
  rule.ordinary = field.flag("ordinary");
  if (field.contains("role"))
    rule.meaning = {read_meaning(Channels::kWhole, field["role"])};
  else
    rule.meaning = read_channels(field["channels"]);
  return rule;
}

Habit read_habit(const Field& field) {
  refuse_unknown_fields(field, {"name", "camel_case", "resolution", "rules"});
  Habit habit;
  habit.name = field["name"].text();
  field["name"].require(!habit.name.empty(), "a name");
  habit.camel_case = field.flag("camel_case");
  if (field.contains("resolution"))
    habit.resolution = read_named(field["resolution"], kResolutionPlaces, "place of a resolution");
  habit.rules = field["rules"].list(1, read_rule);

  std::set<std::string> earlier;
  for (const NamingRule& rule : habit.rules) {
    std::set<std::string> own;
    for (const std::string& word : rule.words) own.insert(word_key(word));
    for (const std::string& key : own)
      if (!earlier.insert(key).second) field.fail("two rules for the word '" + key + "' (keep one)");
  }
  return habit;
}

struct NamingTables {
  std::vector<Habit> habits;
  std::vector<std::string> ignored_words;
};

NamingTables read_tables(std::string_view text, const std::string& context) {
  const Json json = parse_json(text, context);
  const Field field(json, context);
  refuse_unknown_fields(field, {"habits", "ignored_words"});
  NamingTables tables;
  tables.habits = field["habits"].list(1, read_habit);
  if (field.contains("ignored_words")) tables.ignored_words = field["ignored_words"].list(0, read_word);
  return tables;
}

// Returns a convention for the names of inputs, such as coat_weight, that no other convention has. Leaves out
// names of one word, because they also occur in names of objects.
Habit surface_habit(const std::vector<Habit>& others) {
  std::set<std::string> known;
  for (const Habit& habit : others)
    for (const NamingRule& rule : habit.rules)
      for (const std::string& word : rule.words) known.insert(word_key(word));
  Habit habit{"surface models", true, false, ResolutionPlace::kNone, {}};
  for (const std::string& name : parameter_names()) {
    const auto parameter = *parameter_named(name);
    const bool is_one_word =
        std::ranges::none_of(name, [](char c) { return c == '_' || (c >= 'A' && c <= 'Z'); });
    if (is_input(parameter) && !is_one_word && known.insert(word_key(name)).second)
      habit.rules.push_back({{name}, false, {{Channels::kWhole, Role::kOther, parameter}}});
  }
  return habit;
}

}  // namespace

const Naming& built_in_naming() {
  static const Naming naming = [] {
    NamingTables tables = read_tables(kNamingText, "naming.json");
    for (Habit& habit : tables.habits) habit.built_in = true;
    tables.habits.push_back(surface_habit(tables.habits));
    return Naming(std::move(tables.habits), std::move(tables.ignored_words));
  }();
  return naming;
}

Naming parse_naming(std::string_view text, const std::string& context) {
  NamingTables tables = read_tables(text, context);
  const Naming& built_in = built_in_naming();
  tables.habits.insert(tables.habits.end(), built_in.habits().begin(), built_in.habits().end());
  tables.ignored_words.insert(tables.ignored_words.end(), built_in.ignored_words().begin(),
                              built_in.ignored_words().end());
  return Naming(std::move(tables.habits), std::move(tables.ignored_words));
}

Naming read_naming(const std::filesystem::path& file) { return parse_naming(read_file(file), file.string()); }

}  // namespace remap
