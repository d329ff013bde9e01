// SPDX-License-Identifier: BSD-3-Clause
// The keywords that decide what contact of a deck means, with their parameters and the columns of their data lines:
// what of it is used, what makes no difference to contact elements, what is refused. Nothing of a keyword in this
// table is passed over: what the table does not name is refused, too.
#pragma once

#include <string>
#include <vector>

#include "source.hpp"

namespace ents_deck {

enum class Program { calculix, abaqus };

enum class Use { used, no_effect, refused };

struct ParameterRule {
  std::string name;
  Use use = Use::used;
  std::string values; ///< "A|B": one of these, "|A": or none, "*": anything, "": it has no value,
                      ///< "!A|B": anything but these
  std::string why; ///< of what is refused: the reason and what to write; of what has no effect: what to tell
};

struct ColumnRule {
  std::string name; ///< as in messages
  Use use = Use::used;
  std::string only = ""; ///< of what is refused: a number that the column may have
  std::string why = "";
};

struct KeywordRule {
  std::string name;
  Use use = Use::used;
  std::string why; ///< of a keyword that is refused as a whole, or that has no effect
  std::vector<ParameterRule> parameters;
  std::vector<ColumnRule>
      columns; ///< of a data line; empty: the columns are checked where the lines are read
  int most_lines = 1 << 30;
  bool of_pair = false; ///< matters to the pairs that use it alone: others may be left to the program
};

/// Rules for a host program, by name.
const std::vector<KeywordRule>& keyword_rules(Program program);

/// Looks at all statements but those of pairs and their interactions.
/// @throws Error with file and line of the first keyword, parameter, value or number that is refused, or is none that
/// the table knows; or of a keyword that is spelled almost as one of the table
/// @return what the user has to know of keywords without effect, a sentence each
std::vector<std::string> check_keywords(const Source& source, Program program);

/// Below *SURFACE INTERACTION: physics that no contact element has.
const std::vector<const char*>& keywords_of_interactions();

/// The same for one statement. @return what the user has to know of parameters without effect, a sentence each
std::vector<std::string> check_statement(const Source& source, const Statement& statement, Program program);

} // namespace ents_deck
