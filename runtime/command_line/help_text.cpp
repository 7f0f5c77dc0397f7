#include "command_line/help_text.hpp"

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/contains.hpp"
namespace remap {
namespace {

constexpr std::size_t kWidth = 80, kDescriptionColumn = 26;
constexpr const char* kHelpGroup = "Help";

constexpr std::string_view kRarePrefix = "Rare: ";
bool is_rare(const std::string& group) { return group.starts_with("Rare"); }

// Returns `Output` for `Rare: output`.
std::string heading(std::string group) {
  if (!group.starts_with(kRarePrefix)) return group;
  group.erase(0, kRarePrefix.size());
  group.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(group.front())));
  return group;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// Removes `first` and `last` from the ends of `text` if both are there.
std::string without_quotes(const std::string& text, char first, char last) {
  const bool quoted = text.size() >= 2 && text.front() == first && text.back() == last;
  return quoted ? text.substr(1, text.size() - 2) : text;
}

// Wraps one line, broken at blanks.
std::string wrapped_line(std::string_view line, std::size_t indent) {
  if (line.starts_with(' ')) return std::string(line);
  std::string result;
  std::size_t column = indent;
  while (!line.empty()) {
    const std::string_view word = line.substr(0, line.find(' '));
    line.remove_prefix(std::min(word.size() + 1, line.size()));
    if (column > indent && column + 1 + word.size() > kWidth) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result;
}

// Returns a list entry in two columns: `  --name VALUE  Description`.
std::string entry(const std::string& name, const std::string& description) {
  std::string line = "  " + name;
  if (description.empty()) return line + "\n";
  if (line.size() + 2 > kDescriptionColumn)
    line += "\n" + std::string(kDescriptionColumn, ' ');
  else
    line.resize(kDescriptionColumn, ' ');
  return line + wrapped(description, kDescriptionColumn) + "\n";
}

// Splits the type of the value from the descriptions of its checks. CLI11 joins them as `TYPE:CHECK`.
std::pair<std::string, std::string> type_and_checks(const CLI::Option& option) {
  const std::string text = option.get_type_name();
  std::size_t colon = std::string::npos;  // a name may contain colons, such as FILE[:CHANNEL]
  for (const char* check : {":{", ":POSITIVE", ":NONNEGATIVE"}) colon = std::min(colon, text.find(check));
  if (const std::size_t range = text.find(" in ["); colon == std::string::npos && range != std::string::npos)
    colon = text.rfind(':', range);
  if (colon == std::string::npos) return {text, ""};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

std::string value_name(const CLI::Option& option) {
  if (option.get_type_size() == 0) return "";
  const std::string type = type_and_checks(option).first;
  if (type == "INT" || type == "UINT") return " N";
  if (type == "FLOAT") return " NUMBER";
  if (type == "TEXT" && !allowed_values(option).empty()) return " NAME";
  return type.empty() ? "" : " " + type;
}

std::string default_text(const CLI::Option& option) {
  return replaced(without_quotes(without_quotes(option.get_default_str(), '[', ']'), '"', '"'), "\"", "");
}

// Returns the description of an option for help and for messages. If `whole` is set, it also lists the
// options that this option excludes.
std::string option_description(const CLI::Option& option, bool whole) {
  std::vector<std::string> remarks;
  if (const std::string allowed = allowed_values(option); !allowed.empty())
    remarks.push_back(type_and_checks(option).second.starts_with("{") ? "one of " + allowed : allowed);
  if (option.get_required()) remarks.push_back("required");
  std::set<std::string> excluded;  // sorted, because CLI11 sorts by address, which varies
  if (whole)
    for (const CLI::Option* other : option.get_excludes()) excluded.insert(other->get_name());
  for (const std::string& name : excluded) remarks.push_back("not with " + name);
  if (const std::string value = default_text(option); !value.empty()) remarks.push_back("default: " + value);
  std::string text = option.get_description();
  for (std::size_t i = 0; i < remarks.size(); ++i) text += (i == 0 ? " (" : "; ") + remarks[i];
  return remarks.empty() ? text : text + ")";
}

using Options = std::vector<const CLI::Option*>;

Options positionals(const CLI::App& app) {
  return app.get_options(
      [](const CLI::Option* option) { return option->get_positional() && !option->get_group().empty(); });
}

// Returns false for commands that only print where they are now. They have no group.
bool is_shown(const CLI::App* command) { return !command->get_group().empty(); }

std::string usage(const CLI::App& app, const std::string& name) {
  std::string text = "Usage: " + name;
  if (!app.get_subcommands([](const CLI::App*) { return true; }).empty()) return text + " COMMAND [options]";
  for (const CLI::Option* option : positionals(app)) {
    const std::string word =
        option->get_name(true, false) +
        (option->get_expected_max() >= CLI::detail::expected_max_vector_size ? "..." : "");
    text += option->get_required() ? " " + word : " [" + word + "]";
  }
  return text + " [options]";
}

// Returns the groups in the order of their first options. The group of help is next to last, and rare groups
// are last.
std::vector<std::string> groups(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (const std::string& group = option->get_group();
        option->nonpositional() && !group.empty() && !contains(names, group))
      names.push_back(group);
  std::ranges::stable_sort(names, [](const std::string& a, const std::string& b) {
    const auto rank = [](const std::string& name) { return is_rare(name) ? 2 : name == kHelpGroup ? 1 : 0; };
    return rank(a) < rank(b);
  });
  return names;
}

Options options_of(const CLI::App& app, const std::string& group) {
  return app.get_options([&group](const CLI::Option* option) {
    return option->nonpositional() && option->get_group() == group;
  });
}

std::string option_names(const CLI::Option& option) {
  return option.nonpositional() ? replaced(option.get_name(false, true), ",", ", ")
                                : option.get_name(true, false);
}

class HelpFormatter : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    const bool all = mode == CLI::AppFormatMode::All;
    std::string text = wrapped(app->get_description(), 0) + "\n\n" + usage(*app, name) + "\n";
    text += arguments(*app, all) + commands(*app);
    std::size_t hidden = 0;
    for (const std::string& group : groups(*app)) {
      const auto options = options_of(*app, group);
      if (is_rare(group) && !all)
        hidden += options.size();
      else
        text += "\n" + heading(group) + ":\n" + entries(options, all);
    }
    if (const std::string footer = app->get_footer(); !footer.empty())
      text += "\n" + wrapped(footer, 0) + "\n";
    if (hidden != 0)
      text += "\nSee " + name + " --help-all for " + std::to_string(hidden) + " more option" +
              (hidden == 1 ? "" : "s") + ".\n";
    return text;
  }

 private:
  static std::string arguments(const CLI::App& app, bool whole) {
    const Options options = positionals(app);
    std::string text = options.empty() ? "" : "\nArguments:\n";
    for (const CLI::Option* option : options)
      text += entry(option_names(*option), option_description(*option, whole));
    return text;
  }

  // Returns the commands of a program, by group.
  static std::string commands(const CLI::App& app) {
    std::vector<std::string> names;
    const auto all = app.get_subcommands(is_shown);
    for (const CLI::App* command : all)
      if (!contains(names, command->get_group())) names.push_back(command->get_group());
    std::string text;
    for (const std::string& name : names) {
      text += "\n" + (name == "Subcommands" ? std::string("Commands") : name) + ":\n";
      for (const CLI::App* command : all)
        if (command->get_group() == name) text += entry(command->get_name(), command->get_description());
    }
    return text;
  }

  static std::string entries(const Options& options, bool whole) {
    std::string text;
    for (const CLI::Option* option : options)
      text += entry(option_names(*option) + value_name(*option), option_description(*option, whole));
    return text;
  }
};

bool has_rare_options(const CLI::App& app) {
  const auto options = app.get_options();
  return std::ranges::any_of(options, [](const CLI::Option* option) { return is_rare(option->get_group()); });
}

void lay_out(CLI::App& app, const std::shared_ptr<HelpFormatter>& formatter) {
  app.formatter(formatter);
  app.set_help_flag("-h,--help", "Show this help")->group(kHelpGroup);
  // Every command accepts the flag, but only commands with rare options show it.
  app.set_help_all_flag("--help-all", "Show all options")->group(has_rare_options(app) ? kHelpGroup : "");
  if (CLI::Option* version = app.get_option_no_throw("--version"))
    version->group(kHelpGroup)->description("Show the version");
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    lay_out(*command, formatter);
}

Json options_json(const Options& options) {
  Json list = Json::list();
  for (const CLI::Option* option : options) {
    const bool chooses = type_and_checks(*option).second.starts_with("{");
    list.push_back({{"names", option_names(*option)},
                    {"value", value_name(*option)},
                    {"choices", chooses ? allowed_values(*option) : ""},
                    {"repeats", option->get_items_expected_max() > 1},
                    {"description", option_description(*option, true)}});
  }
  return list;
}

}  // namespace

Json help_table(const CLI::App& app) {
  Json options = Json::list(), commands = Json::list();
  for (const std::string& group : groups(app))
    options.push_back({{"group", heading(group)}, {"options", options_json(options_of(app, group))}});
  for (const CLI::App* command : app.get_subcommands(is_shown)) commands.push_back(help_table(*command));
  return {{"name", command_words(app)}, {"description", app.get_description()},
          {"group", app.get_group()},   {"usage", usage(app, command_words(app))},
          {"footer", app.get_footer()}, {"arguments", options_json(positionals(app))},
          {"groups", options},          {"commands", commands}};
}

void lay_out_help(CLI::App& app) { lay_out(app, std::make_shared<HelpFormatter>()); }

std::string command_words(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : command_words(*parent) + " " + command.get_name();
}

std::string allowed_values(const CLI::Option& option) {
  const std::string checks = type_and_checks(option).second;
  if (checks.starts_with("{")) return replaced(without_quotes(checks, '{', '}'), ",", ", ");
  if (checks == "POSITIVE") return "above 0";
  if (checks == "NONNEGATIVE") return "0 or more";
  const std::size_t open = checks.find(" in ["), middle = checks.find(" - ");
  if (open == std::string::npos || middle == std::string::npos) return "";
  const std::string least = checks.substr(open + 5, middle - open - 5),
                    most = checks.substr(middle + 3, checks.size() - middle - 4);
  constexpr std::size_t kDigitsOfLimits = 10;  // more digits are limits of a type, which help nobody
  return most.size() >= kDigitsOfLimits ? least + " or more" : least + " to " + most;
}

std::string wrapped(std::string_view text, std::size_t indent) {
  std::string result;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += wrapped_line(text.substr(0, end), indent);
    if (end == text.size()) return result;
    text.remove_prefix(end + 1);
    result += text.empty() || text.front() == '\n' ? "\n" : "\n" + std::string(indent, ' ');
  }
}

}  // namespace remap
