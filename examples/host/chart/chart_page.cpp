// SPDX-License-Identifier: BSD-3-Clause
#include "chart/chart_page.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "output/table.hpp"

namespace host::chart {
namespace {

std::string hex(unsigned rgb) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%06x", rgb);
  return text.data();
}

std::string fate_text(const Cell& cell) {
  std::string text = word(cell.fate);
  if (cell.fate == Fate::flagged)
    text += cell.outcome.end == End::status ? ": status " + std::to_string(cell.outcome.status)
                                            : std::string(": ") + word(cell.outcome.end);
  return text + ", " + std::to_string(cell.outcome.iterations) + " iterations";
}

constexpr int cell_size = 14, left_of_map = 40, below_map = 34, above_map = 4;

/// One panel: cells, ends of the axes, what a cell says when it is pointed at.
std::string panel_svg(const Map& map, const Panel& panel) {
  const std::size_t columns = map.x.values.size(), rows = map.y.values.size();
  const int width = static_cast<int>(columns) * cell_size, height = static_cast<int>(rows) * cell_size;
  const auto px = [](int value) { return std::to_string(value); };
  // Names of axes may be longer than a map of few points.
  const auto half = [](const std::string& text) { return 7 * static_cast<int>(text.size()) / 2; };
  const int x_half = half(map.x.label), y_half = half(map.y.label), x_middle = left_of_map + width / 2,
            y_middle = above_map + height / 2;
  const int x0 = std::min(0, x_middle - x_half), x1 = std::max(left_of_map + width + 6, x_middle + x_half);
  const int y0 = std::min(0, y_middle - y_half),
            y1 = std::max(above_map + height + below_map, y_middle + y_half);
  std::string svg = "<svg viewBox=\"" + px(x0) + " " + px(y0) + " " + px(x1 - x0) + " " + px(y1 - y0) +
                    "\" role=\"img\" aria-label=\"" +
                    escaped(map.title + ", " + word(panel.method.surface) + ", " +
                            word(panel.method.projection) + ", " + word(panel.method.tangent)) +
                    "\">";
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const Cell& cell = panel.cells[j * columns + i];
      const Look look = look_of(cell);
      const int x = left_of_map + static_cast<int>(i) * cell_size,
                y = above_map + height - static_cast<int>(j + 1) * cell_size;
      svg += "<g><title>" + format_number(map.x.values[i], 3) + ", " + format_number(map.y.values[j], 3) +
             ": " + escaped(fate_text(cell)) + "</title><rect x=\"" + px(x) + "\" y=\"" + px(y) +
             "\" width=\"14\" height=\"14\" fill=\"" + hex(look.rgb) + "\"/>";
      if (look.letter != 0)
        svg += "<text x=\"" + px(x + 7) + "\" y=\"" + px(y + 10) + "\"" +
               (cell.fate == Fate::wrong ? " fill=\"#fff\"" : "") + ">" + std::string(1, look.letter) +
               "</text>";
      svg += "</g>";
    }
  const auto label = [&](int x, int y, const char* anchor, const std::string& text, const char* more = "") {
    svg += "<text class=\"a\" x=\"" + px(x) + "\" y=\"" + px(y) + "\" style=\"text-anchor:" + anchor + "\"" +
           more + ">" + escaped(text) + "</text>";
  };
  label(left_of_map, above_map + height + 14, "start", format_number(map.x.values.front(), 2));
  label(left_of_map + width, above_map + height + 14, "end", format_number(map.x.values.back(), 2));
  label(left_of_map + width / 2, above_map + height + 29, "middle", map.x.label);
  label(left_of_map - 4, above_map + height - 3, "end", format_number(map.y.values.front(), 2));
  label(left_of_map - 4, above_map + 11, "end", format_number(map.y.values.back(), 2));
  const std::string turn = " transform=\"rotate(-90 10 " + px(above_map + height / 2) + ")\"";
  label(10, above_map + height / 2, "middle", map.y.label, turn.c_str());
  return svg + "</svg>";
}

std::array<int, 5> count(const Panel& panel) {
  std::array<int, 5> counts{};
  for (const Cell& cell : panel.cells) ++counts[static_cast<std::size_t>(cell.fate)];
  return counts;
}

std::string counts_table(const Map& map) {
  std::string html = "<div "
                     "class=\"wide\"><table><tr><th>surface</th><th>projection</th><th>tangent</"
                     "th><th>solved</th><th>flagged</th>"
                     "<th>diverged</th><th>silently wrong</th><th>median iterations</th></tr>";
  for (const Panel& panel : map.panels) {
    const auto counts = count(panel);
    std::vector<int> iterations;
    for (const Cell& cell : panel.cells)
      if (cell.fate == Fate::solved) iterations.push_back(cell.outcome.iterations);
    std::sort(iterations.begin(), iterations.end());
    html += std::string("<tr") + (panel.careful ? "" : " class=\"careless\"") + "><td>" +
            escaped(word(panel.method.surface)) + "</td><td>" + word(panel.method.projection) + "</td><td>" +
            word(panel.method.tangent) + (panel.careful ? "" : ", no rules") + "</td>";
    for (std::size_t k = 0; k < 4; ++k) html += "<td>" + std::to_string(counts[k]) + "</td>";
    html += "<td>" +
            (iterations.empty() ? std::string("-") : std::to_string(iterations[iterations.size() / 2])) +
            "</td></tr>";
  }
  return html + "</table></div>";
}

constexpr const char* style = R"(
:root{color-scheme:light}
body{font:16px/1.5 system-ui,Helvetica,Arial,sans-serif;color:#222;margin:0 auto;max-width:1180px;padding:0 14px 40px}
h1{font-size:1.5em;margin:.8em 0 .2em}h2{margin-top:2em;border-top:1px solid #ccc;padding-top:.6em}h3{margin:1.6em 0 .3em}
h4{margin:.9em 0 .2em;font-size:1em}
p,li{max-width:46em}
.panels{display:grid;grid-template-columns:repeat(6,1fr);gap:6px 10px}
figure{margin:0}figcaption{font-size:.8em;line-height:1.2;margin-left:18%}
svg{width:100%;height:auto;display:block}svg text{font:9px Helvetica,Arial,sans-serif;text-anchor:middle}svg text.a{font-size:12px}
table{border-collapse:collapse;font-size:.86em}td,th{padding:2px 9px;text-align:left;border-bottom:1px solid #ddd;vertical-align:top}
tr.new td{border-top:2px solid #bbb}
.wide{overflow-x:auto;background:linear-gradient(to right,#fff 40%,#fff0) local 0 0/36px 100% no-repeat,linear-gradient(to left,#fff 40%,#fff0) local 100% 0/36px 100% no-repeat,linear-gradient(to right,#0003,#0000) 0 0/12px 100% no-repeat,linear-gradient(to left,#0003,#0000) 100% 0/12px 100% no-repeat}
.wide.over::before{content:"more columns: scroll the table to the right \2192";position:sticky;left:0;display:inline-block;font-size:.8em;color:#555}
.careless{color:#777}
.key{display:flex;flex-wrap:wrap;gap:4px 16px;font-size:.86em;margin:.8em 0}
.key span{display:inline-flex;align-items:center;gap:6px}.key i{width:15px;height:15px;font:normal 11px/15px Helvetica,Arial;text-align:center}
nav a{margin-right:1em}
.charts{display:grid;grid-template-columns:repeat(2,1fr);gap:2px 22px}
svg.w text{font:13px Helvetica,Arial,sans-serif;fill:#222}svg.k{width:15px;height:15px}
.g{stroke:#e4e4e4;fill:none}.t{stroke:#999;fill:none}.x{stroke:#444;fill:none}.one{stroke:#888;stroke-dasharray:5 4;fill:none}
.f{stroke:#c9c9c9;stroke-width:7;fill:none;stroke-linejoin:round;stroke-linecap:round}.l{fill:none;stroke-width:1.4;opacity:.55}
@media(max-width:760px){.charts{grid-template-columns:1fr}}
@media(max-width:900px){.panels{grid-template-columns:repeat(3,1fr)}}
@media(max-width:560px){.panels{grid-template-columns:repeat(2,1fr)}}
)";

/// Tables that do not fit say that they scroll.
constexpr const char* script = R"(
<script>{const mark=()=>document.querySelectorAll('.wide').forEach(e=>e.classList.toggle('over',e.scrollWidth>e.clientWidth+1));
addEventListener('resize',mark);mark()}</script>)";

} // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '&':
      out += "&amp;";
      break;
    case '"':
      out += "&quot;";
      break;
    default:
      out += c;
    }
  return out;
}

std::string legend() {
  std::string html = "<div class=\"key\">";
  const auto entry = [&](unsigned rgb, const std::string& letter, const std::string& text) {
    html += "<span><i style=\"background:" + hex(rgb) + "\">" + letter + "</i>" + escaped(text) + "</span>";
  };
  constexpr std::array<const char*, 5> ranges{"solved, < 32 iterations in all", "< 128", "< 512", "< 2048",
                                              "more"};
  for (std::size_t k = 0; k < ranges.size(); ++k) entry(iterations_color(16 << (2 * k)), "", ranges[k]);
  Cell cell;
  cell.fate = Fate::flagged;
  for (const End end : {End::fold, End::edge, End::self_shadow, End::crossing, End::ambiguous, End::behind,
                        End::jump, End::unstable}) {
    cell.outcome.end = end;
    const Look look = look_of(cell);
    entry(look.rgb, std::string(1, look.letter), word(end));
  }
  cell.outcome.end = End::status;
  entry(look_of(cell).rgb, "6", "a digit: that status of ents.h (6: penetration limit)");
  cell.fate = Fate::diverged;
  entry(look_of(cell).rgb, "", "diverged, in spite of six halvings");
  cell.fate = Fate::wrong;
  entry(look_of(cell).rgb, "W", "silently wrong");
  return html + "</div>";
}

std::string map_section(const Map& map) {
  std::string html =
      "<h3 id=\"" + map.name + "\">" + escaped(map.title) + "</h3><p>" + escaped(map.text) + "</p>";
  for (const SurfaceKind surface : map.surfaces) {
    html += std::string("<h4>") + escaped(word(surface)) + "</h4><div class=\"panels\">";
    for (const Panel& panel : map.panels) {
      if (panel.method.surface != surface || !panel.careful) continue;
      html += "<figure>" + panel_svg(map, panel) + "<figcaption>" + word(panel.method.projection) + ", " +
              word(panel.method.tangent) + "</figcaption></figure>";
    }
    html += "</div>";
  }
  return html + "<h4>Counts</h4>" + counts_table(map);
}

std::string wrong_heights_section(const std::vector<WrongHeight>& rows) {
  std::string html = "<div class=\"wide\"><table><tr><th>Fig. 4</th><th>wrong "
                     "because</th><th>example</th><th>ents_surface_check says</th><th>on the way</th></tr>";
  for (const WrongHeight& row : rows)
    html += "<tr><td>" + row.panel + "</td><td>" + escaped(row.what) + "</td><td>" + escaped(row.example) +
            "</td><td>" + escaped(row.check) + "</td><td>" + escaped(row.running) + "</td></tr>";
  return html + "</table></div>";
}

std::string page(const std::vector<Section>& sections, const std::string& version) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
                     "name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
                     "<title>ents: charts</title><style>" +
                     std::string(style) + "</style></head><body><h1>ents " + escaped(version) +
                     ": charts</h1><nav>";
  for (const Section& section : sections)
    html += "<a href=\"#" + section.id + "\">" + escaped(section.title) + "</a>";
  html += "</nav>";
  for (const Section& section : sections)
    html += "\n<section id=\"" + section.id + "\"><h2>" + escaped(section.title) + "</h2>" + section.html +
            "</section>";
  return html + std::string(script) + "\n</body></html>\n";
}

} // namespace host::chart
