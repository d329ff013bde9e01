// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/expression_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <tao/pegtl.hpp>

#include "abi/read/json_check.hpp"
#include "abi/read/model_error.hpp"
#include "abi/read/number_text.hpp"
#include "core/height/expression.hpp"

namespace ents {

namespace {

namespace peg = tao::pegtl;
using Function = ExpressionOperation;

constexpr std::size_t longest_text = 4000, most_nested = 50;

constexpr std::pair<std::string_view, Function> functions[] = {{"exp", Function::exponential},
                                                               {"log", Function::logarithm},
                                                               {"sin", Function::sine},
                                                               {"cos", Function::cosine},
                                                               {"tan", Function::tangent},
                                                               {"sinh", Function::hyperbolic_sine},
                                                               {"cosh", Function::hyperbolic_cosine},
                                                               {"tanh", Function::hyperbolic_tangent},
                                                               {"atan", Function::arctangent},
                                                               {"asin", Function::arcsine},
                                                               {"acos", Function::arccosine},
                                                               {"sqrt", Function::root},
                                                               {"bump", Function::bump}};

// Functions of other languages, and what to write instead.
constexpr std::pair<std::string_view, std::string_view> refused[] = {
    {"abs", "has a kink; write sqrt(x^2 + d^2) with a small length d"},
    {"sign", "has a jump; write tanh(x/d) with a small length d"},
    {"sgn", "has a jump; write tanh(x/d) with a small length d"},
    {"step", "has a jump; write 0.5*(1 + tanh(x/d)) with a small length d"},
    {"heaviside", "has a jump; write 0.5*(1 + tanh(x/d)) with a small length d"},
    {"min", "has a kink; write 0.5*(a + b - sqrt((a - b)^2 + d^2)) with a small height d"},
    {"max", "has a kink; write 0.5*(a + b + sqrt((a - b)^2 + d^2)) with a small height d"},
    {"floor", "has jumps; write a periodic height, like atan(tan(x)) with rounded edges by \"thread\""},
    {"ceil", "has jumps; write a periodic height, like one of sines, or a \"thread\""},
    {"round", "has jumps; write a periodic height, like one of sines, or a \"thread\""},
    {"mod", "has jumps; write a periodic height, like one of sines, or a \"thread\""},
    {"fmod", "has jumps; write a periodic height, like one of sines, or a \"thread\""},
    {"if", "has a kink; write a sum of smooth terms, each times 0.5*(1 + tanh(x/d))"},
    {"atan2", "has a jump; write atan(y/x) where x keeps its sign"},
    {"pow", "is written a^b"},
    {"ln", "is written log(x)"},
    {"log10", "is written log(x)/log(10)"},
    {"log2", "is written log(x)/log(2)"},
    {"arctan", "is written atan(x)"},
    {"arcsin", "is written asin(x)"},
    {"arccos", "is written acos(x)"},
    {"erf", "is not among the functions; tanh(1.2*x) is close to it"}};

template <class Table> std::vector<std::string_view> names_of(const Table& table) {
  std::vector<std::string_view> names;
  for (const auto& entry : table) names.push_back(entry.first);
  return names;
}

struct ParseState {
  ExpressionBuilder builder;
  const ExpressionNames& names;
  std::vector<int> operands;
  std::vector<Function> waiting; // functions whose argument is being read

  int pop() {
    const int last = operands.back();
    operands.pop_back();
    return last;
  }
  template <class F> void combine(F&& f) {
    const int b = pop(), a = pop();
    operands.push_back(f(a, b));
  }
};

// ---- grammar

struct blanks : peg::star<peg::blank> {};
struct digits : peg::plus<peg::digit> {};
struct exponent_of_ten : peg::seq<peg::one<'e', 'E'>, peg::opt<peg::one<'+', '-'>>, digits> {};
struct number : peg::seq<peg::sor<peg::seq<digits, peg::opt<peg::one<'.'>, peg::star<peg::digit>>>,
                                  peg::seq<peg::one<'.'>, digits>>,
                         peg::opt<exponent_of_ten>> {};
struct name : peg::identifier {};
struct function : peg::seq<peg::identifier, blanks, peg::at<peg::one<'('>>> {};
struct expression;
struct closing : peg::one<')'> {};
struct opening : peg::seq<peg::one<'('>, blanks> {};
struct call : peg::seq<function, opening, peg::must<expression, closing>> {};
struct parentheses : peg::if_must<opening, expression, closing> {};
struct operand : peg::sor<number, call, name, parentheses> {};
struct factor;
struct raised : peg::if_must<peg::seq<peg::one<'^'>, blanks>, factor> {};
struct power : peg::seq<operand, blanks, peg::opt<raised>> {};
struct negative : peg::if_must<peg::seq<peg::one<'-'>, blanks>, factor> {};
struct positive : peg::if_must<peg::seq<peg::one<'+'>, blanks>, factor> {};
struct factor : peg::sor<negative, positive, power> {};
struct times : peg::if_must<peg::seq<peg::one<'*'>, blanks>, factor> {};
struct over : peg::if_must<peg::seq<peg::one<'/'>, blanks>, factor> {};
struct term : peg::seq<factor, peg::star<peg::sor<times, over>>> {};
struct plus : peg::if_must<peg::seq<peg::one<'+'>, blanks>, term> {};
struct minus : peg::if_must<peg::seq<peg::one<'-'>, blanks>, term> {};
struct expression : peg::seq<term, peg::star<peg::sor<plus, minus>>> {};
struct whole_text : peg::must<blanks, expression, peg::eof> {};

constexpr const char* wanted_operand = "expected a number, a name, a function, \"-\" or \"(\"";
// A rule with a text here must match wherever it is tried.
template <class Rule> constexpr const char* expected = nullptr;
template <> constexpr const char* expected<blanks> = wanted_operand; // never: blanks may be none
template <> constexpr const char* expected<expression> = wanted_operand;
template <> constexpr const char* expected<term> = wanted_operand;
template <> constexpr const char* expected<factor> = wanted_operand;
template <> constexpr const char* expected<closing> = "expected an operator (+ - * / ^) or \")\"";
template <> constexpr const char* expected<peg::eof> = "expected an operator (+ - * / ^) or the end";
struct Expected {
  template <class Rule> static constexpr const char* message = expected<Rule>;
};
template <class Rule> using Control = peg::must_if<Expected>::control<Rule>;

// ---- what the rules do

template <class Rule> struct Action {};

template <> struct Action<number> {
  template <class Input> static void apply(const Input& in, ParseState& s) {
    double value = 0.0;
    if (read_number(in.string_view(), value) != NumberText::ok || std::fabs(value) > 1e100)
      throw peg::parse_error("the number " + in_quotes(in.string_view()) + " is above 1e100", in);
    s.operands.push_back(s.builder.number(value));
  }
};

int index_of(const std::vector<NamedNumber>& list, std::string_view name) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const NamedNumber& n) { return n.name == name; });
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

template <> struct Action<name> {
  template <class Input> static void apply(const Input& in, ParseState& s) {
    const std::string_view text = in.string_view();
    ExpressionBuilder& b = s.builder;
    if (text == "u" || (text == "v" && s.names.dimension == 2))
      return s.operands.push_back(b.coordinate(text == "v"));
    if (text == "pi") return s.operands.push_back(b.number(3.141592653589793));
    if (text == "e") return s.operands.push_back(b.number(2.718281828459045));
    if (const int i = index_of(s.names.constants, text); i >= 0)
      return s.operands.push_back(b.number(s.names.constants[static_cast<std::size_t>(i)].value));
    if (const int i = index_of(s.names.parameters, text); i >= 0) return s.operands.push_back(b.parameter(i));
    if (text == "v") throw peg::parse_error("a line segment has one surface coordinate, \"u\"", in);
    if (std::ranges::count(names_of(functions), text) > 0)
      throw peg::parse_error(in_quotes(text) + " is a function: write its argument in parentheses", in);
    std::vector<std::string_view> known = {"u", "pi", "e"};
    if (s.names.dimension == 2) known.push_back("v");
    for (const auto* list : {&s.names.constants, &s.names.parameters})
      for (const NamedNumber& n : *list) known.push_back(n.name);
    throw peg::parse_error(in_quotes(text) +
                               " is no surface coordinate, constant or parameter of this height" +
                               suggestion(text, known) + "; give its value in \"constants\"",
                           in);
  }
};

template <> struct Action<function> {
  template <class Input> static void apply(const Input& in, ParseState& s) {
    std::string_view text = in.string_view();
    text = text.substr(0, text.find_last_not_of(" \t") + 1);
    for (const auto& [known, operation] : functions)
      if (text == known) return s.waiting.push_back(operation);
    for (const auto& [known, why] : refused)
      if (text == known) throw peg::parse_error(in_quotes(text) + " " + std::string(why), in);
    throw peg::parse_error(in_quotes(text) + " is not one of the functions " +
                               alternatives(names_of(functions)) + suggestion(text, names_of(functions)),
                           in);
  }
};

template <> struct Action<call> {
  static void apply0(ParseState& s) {
    const Function f = s.waiting.back();
    s.waiting.pop_back();
    const int a = s.pop();
    s.operands.push_back(f == Function::root   ? s.builder.root(a, 1)
                         : f == Function::bump ? s.builder.bump(a, 4)
                                               : s.builder.apply(f, a));
  }
};

// a^b: by products where b is a whole number, by a root where it is half of one.
int raise(ExpressionBuilder& b, int base, int exponent) {
  if (double n = 0.0; b.is_number(exponent, n) && std::fabs(n) <= ExpressionBuilder::most_power) {
    if (n == std::floor(n)) return b.power(base, static_cast<int>(n));
    if (2.0 * n == std::floor(2.0 * n) && std::fabs(2.0 * n) <= ExpressionBuilder::most_power)
      return b.root(base, static_cast<int>(2.0 * n));
  }
  return b.apply(Function::exponential, b.multiply(exponent, b.apply(Function::logarithm, base)));
}

template <> struct Action<raised> {
  static void apply0(ParseState& s) {
    s.combine([&](int a, int b) { return raise(s.builder, a, b); });
  }
};
template <> struct Action<negative> {
  static void apply0(ParseState& s) { s.operands.back() = s.builder.negate(s.operands.back()); }
};
template <> struct Action<times> {
  static void apply0(ParseState& s) {
    s.combine([&](int a, int b) { return s.builder.multiply(a, b); });
  }
};
template <> struct Action<over> {
  static void apply0(ParseState& s) {
    s.combine([&](int a, int b) { return s.builder.divide(a, b); });
  }
};
template <> struct Action<plus> {
  static void apply0(ParseState& s) {
    s.combine([&](int a, int b) { return s.builder.add(a, b); });
  }
};
template <> struct Action<minus> {
  static void apply0(ParseState& s) {
    s.combine([&](int a, int b) { return s.builder.subtract(a, b); });
  }
};

// The rules call themselves: how deeply is limited before they begin. A sign or a power may stand in front of
// another one.
void check_depth(std::string_view text, const std::string& path) {
  if (text.size() > longest_text)
    fail(ENTS_BAD_VALUE, path,
         "has " + std::to_string(text.size()) + " characters; at most " + std::to_string(longest_text) +
             " are possible");
  std::size_t open = 0, signs = 0, powers = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(') ++open;
    if (c == ')' && open > 0) --open;
    powers += c == '^';
    if (c == '+' || c == '-')
      ++signs;
    else if (c != ' ' && c != '\t')
      signs = 0;
    if (open > most_nested || signs > most_nested || powers > 4 * most_nested)
      fail(ENTS_BAD_VALUE, path,
           "column " + std::to_string(i + 1) + ": more than " + std::to_string(most_nested) +
               " parentheses or signs, or " + std::to_string(4 * most_nested) +
               " powers, within one another");
  }
}

} // namespace

bool is_expression_name(std::string_view name, std::string& reason) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto later = [&](char c) { return letter(c) || (c >= '0' && c <= '9'); };
  if (name.empty() || !letter(name[0]) || !std::ranges::all_of(name, later)) {
    reason = "is not a name: write a letter, then letters, digits and \"_\"";
    return false;
  }
  for (const std::string_view taken : {"u", "v", "pi", "e"})
    if (name == taken) {
      reason = "is taken: u and v are the surface coordinates, pi and e are known";
      return false;
    }
  if (std::ranges::count(names_of(functions), name) + std::ranges::count(names_of(refused), name) > 0) {
    reason = "is the name of a function";
    return false;
  }
  return true;
}

Height read_expression(std::string_view text, const std::string& path, const ExpressionNames& names,
                       const double (&feature_length)[2]) {
  check_depth(text, path);
  std::vector<double> values;
  for (const NamedNumber& parameter : names.parameters) values.push_back(parameter.value);
  ParseState state{{names.dimension, std::move(values)}, names, {}, {}};
  try {
    peg::memory_input<> in(text.data(), text.data() + text.size(), "");
    peg::parse<whole_text, Action, Control>(in, state);
  } catch (const peg::parse_error& error) {
    fail(ENTS_BAD_VALUE, path,
         "column " + std::to_string(error.positions().front().byte + 1) + ": " +
             std::string(error.message()));
  }
  Height height(names.dimension);
  ExpressionBuilder::TooLong too_long;
  const int result = state.operands.back();
  if (!state.builder.finite())
    fail(ENTS_BAD_VALUE, path,
         "has a part that is constant and no finite number: a division by zero, or a function where it is "
         "not defined");
  if (double value = 0.0; state.builder.is_number(result, value))
    return Height::constant(names.dimension, value);
  if (!state.builder.finish(result, feature_length, height, too_long))
    fail(ENTS_BAD_VALUE, path,
         "needs " + std::to_string(too_long.number) + " " + std::string(too_long.what) +
             " or more, not at most " + std::to_string(too_long.most) +
             "; split it into the parts of a \"sum\" or \"product\"");
  return height;
}

} // namespace ents
