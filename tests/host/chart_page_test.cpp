// SPDX-License-Identifier: BSD-3-Clause
// The page of `ents-lab chart` in a real browser, as wide as a desk and as a phone: are the charts, their
// axes and texts there, and does nothing stick out?
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "program.hpp"

namespace host::chart::chart_page_test {
namespace {

namespace fs = std::filesystem;

std::string shell(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  std::array<char, 4096> part{};
  for (std::size_t count; (count = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    text.append(part.data(), count);
  return pclose(pipe) == 0 ? text : std::string();
}

std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (!shell(std::string("command -v ") + name + " 2>/dev/null").empty()) return name;
  return {};
}

/// What a reader sees is measured in the page itself, laid out in a frame of the given width (a browser's own
/// window has a least width). Boxes are pixels on the screen.
constexpr const char* measure_script = R"(<script>addEventListener('load',()=>{
const all=s=>[...document.querySelectorAll(s)],wide=document.documentElement.clientWidth,box=e=>e.getBoundingClientRect();
const scrolls=e=>{for(;e;e=e.parentElement)if(getComputedStyle(e).overflowX==='auto')return true;return false};
const charts=all('svg.w').map(s=>({width:box(s).width,height:box(s).height,axes:s.querySelectorAll('.x').length,marks:s.querySelectorAll('title').length,
labels:[...s.querySelectorAll('text')].filter(t=>t.textContent).map(t=>t.textContent),
smallest:Math.min(...[...s.querySelectorAll('text')].filter(t=>t.textContent).map(t=>box(t).height)),
over:(()=>{const b=[...s.querySelectorAll('text')].filter(t=>t.textContent).map(box);let n=0;
for(let i=0;i<b.length;i++)for(let j=0;j<i;j++)if(Math.min(b[i].right,b[j].right)-Math.max(b[i].left,b[j].left)>1&&Math.min(b[i].bottom,b[j].bottom)-Math.max(b[i].top,b[j].top)>1)n++;return n})(),
out:[...s.querySelectorAll('text,circle,rect,polygon')].filter(e=>{const b=box(e),c=box(s);return b.width>0&&(b.left<c.left-1||b.right>c.right+1||b.top<c.top-1||b.bottom>c.bottom+1)}).length}));
const out=all('body *').filter(e=>!scrolls(e)&&box(e).width>0&&(box(e).right>wide+1||box(e).left<-1)).map(e=>e.tagName+' '+(e.textContent||'').slice(0,40));
const tables=all('.wide').map(e=>({scrolls:e.scrollWidth>e.clientWidth+1,hint:getComputedStyle(e,'::before').content.includes('scroll')}));
parent.postMessage(JSON.stringify({wide,tables,methods:document.querySelectorAll('#truth ~ .wide')[0].querySelectorAll('tr').length-1,scroll:document.documentElement.scrollWidth,charts,maps:all('.panels svg').length,headings:all('h2').map(h=>h.textContent),
advice:all('li').filter(l=>l.textContent.startsWith('For an error of')).length,out}),'*')})</script>)";

struct Cleared {
  fs::path path;
  ~Cleared() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

/// One run of the command for all tests of a process.
const fs::path& page_folder() {
  static const Cleared folder = [] {
    std::string name = (fs::path(testing::TempDir()) / "ents_chart_page_XXXXXX").string();
    const fs::path path = mkdtemp(name.data());
    const test::ProgramOutput output = test::ents_host(
        "chart --quick --no-pictures --scenes \"" EXAMPLES "\" --out \"" + path.string() + "\"");
    EXPECT_EQ(output.exit_code, 0) << output.text;
    EXPECT_NE(output.text.find("chart: 0 silently wrong"), std::string::npos) << output.text;
    return Cleared{path};
  }();
  return folder.path;
}

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

Json look_at(const std::string& program, int width) {
  const fs::path folder = page_folder();
  std::string page = read(folder / "chart.html");
  page.insert(page.rfind("</body>"), measure_script);
  std::ofstream(folder / "measured.html") << page;
  std::ofstream(folder / "frame.html")
      << "<!DOCTYPE html><body><iframe src=\"measured.html\" style=\"border:0;width:" << width
      << "px;height:900px\"></"
         "iframe><script>addEventListener('message',e=>{document.body.textContent='RESULT'+e.data+'END'})"
         "</script></body>";
  // Without sandbox: it wants rights that containers do not give, and the page is our own.
  const std::string dom =
      shell(program +
            " --headless --no-sandbox --disable-gpu --hide-scrollbars --virtual-time-budget=20000 "
            "--user-data-dir=\"" +
            (folder / "profile").string() + "\" --window-size=1400,1000 --dump-dom \"file://" +
            (folder / "frame.html").string() + "\" 2>/dev/null");
  const std::size_t from = dom.find("RESULT"), to = dom.rfind("END");
  if (from == std::string::npos || to == std::string::npos) return {};
  std::string text = dom.substr(from + 6, to - from - 6);
  for (const auto& [escaped, plain] :
       {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&nbsp;", " "}, {"&amp;", "&"}})
    for (std::size_t at; (at = text.find(escaped)) != std::string::npos;)
      text.replace(at, std::string(escaped).size(), plain);
  return Json::parse(text, nullptr, false);
}

void expect_charts_at(const std::string& program, int width) {
  SCOPED_TRACE("a page " + std::to_string(width) + " pixels wide");
  const Json seen = look_at(program, width);
  ASSERT_TRUE(seen.is_object()) << program << " returned no page";
  EXPECT_EQ(seen.at("wide"), width);
  EXPECT_LE(seen.at("scroll").get<int>(), width) << "the page scrolls sideways";
  EXPECT_TRUE(seen.at("out").empty()) << seen.at("out").dump();
  const Json data = parse_json_file(page_folder() / "chart.json");
  EXPECT_EQ(seen.at("charts").size(), 4 * data.at("work_precision").size());
  std::size_t advice = 0, panels = 0;
  for (const Json& work : data.at("work_precision")) advice += work.at("advice").size();
  for (const Json& map : data.at("stability"))
    for (const Json& panel : map.at("panels")) panels += panel.at("rules").get<bool>() ? 1 : 0;
  EXPECT_EQ(seen.at("advice"), advice);
  EXPECT_EQ(seen.at("maps"), panels);
  EXPECT_EQ(seen.at("headings").size(), 3u);
  std::size_t methods = 0, scrolling = 0;
  for (const Json& work : data.at("work_precision")) methods += work.at("methods").size();
  EXPECT_GT(methods, 20u);
  EXPECT_EQ(seen.at("methods"), methods);
  for (const Json& table : seen.at("tables")) {
    EXPECT_EQ(table.at("scrolls"), table.at("hint")) << "a table that scrolls says so, and no other";
    scrolling += table.at("scrolls").get<bool>();
  }
  if (width < 400) {
    EXPECT_GE(scrolling, 3u);
  }
  for (const Json& chart : seen.at("charts")) {
    EXPECT_EQ(chart.at("over"), 0) << "texts overprint each other: " << chart.dump();
    EXPECT_GT(chart.at("width").get<double>(), 300);
    EXPECT_EQ(chart.at("axes"), 1) << chart.dump();
    EXPECT_EQ(chart.at("out"), 0) << chart.dump();
    EXPECT_GE(chart.at("marks").get<int>(), 3) << chart.dump();
    EXPECT_GE(chart.at("labels").size(), 6u) << chart.dump(); // two axes with two tics and a name each
    EXPECT_GT(chart.at("smallest").get<double>(), 9) << "letters too small to be read: " << chart.dump();
  }
}

void expect_data() {
  const Json data = parse_json_file(page_folder() / "chart.json");
  EXPECT_EQ(data.at("silently_wrong"), 0);
  ASSERT_EQ(data.at("wrong_heights").size(), 4u);
  for (const Json& row : data.at("wrong_heights")) EXPECT_TRUE(row.at("flagged").get<bool>()) << row.dump();
  for (const Json& map : data.at("stability")) {
    const std::size_t points = map.at("x").at("values").size() * map.at("y").at("values").size();
    for (const Json& panel : map.at("panels")) EXPECT_EQ(panel.at("fate").size(), points);
  }
  for (const char* name : {"rough_truth", "rough_truth_area"}) { // against boundary elements
    const auto work = std::find_if(data.at("work_precision").begin(), data.at("work_precision").end(),
                                   [&](const Json& each) { return each.at("name") == name; });
    ASSERT_NE(work, data.at("work_precision").end()) << name;
    std::map<std::string, double> errors;
    for (const Json& run : work->at("runs"))
      if (run.contains("error") && run.at("error").is_number())
        errors[run.at("way").get<std::string>() + ", " + run.at("slave_mesh").get<std::string>() +
               (run.at("counted").get<bool>() ? ", counted" : "")] = run.at("error").get<double>();
    EXPECT_EQ(errors.size(), work->at("runs").size()) << work->dump();
    for (const auto& [way, error] : errors) { // counted on 81 nodes the area is twice the true one and more
      const double most = way.find(", counted") == std::string::npos ? 1 : 2;
      EXPECT_TRUE(error > 0 && error < most) << way << ": " << error;
    }
    if (std::string(name) == "rough_truth_area") {
      EXPECT_LT(errors.at("enriched, elastic layer, 1089 slave nodes, layer"),
                errors.at("enriched, one segment, 81 slave nodes, block"));
    }
  }
}

void expect_one_page() {
  if (!fs::exists(page_folder() / "chart.html")) GTEST_SKIP() << "no matplotlib: install python3-matplotlib";
  const std::string page = read(page_folder() / "chart.html");
  EXPECT_NE(page.find("<svg"), std::string::npos);
  for (const char* outside : {"http:", "https:", "src=", "@import", "url("})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

// One test, because each needs the run of the command, of half a minute: its data; a page that needs no network, on a desk and on a
// phone; and its picture, which is well-formed to a reader of XML.
TEST(Chart, LeavesDataAndAPageThatABrowserShows) {
  expect_data();
  expect_one_page();
  if (IsSkipped()) return;
  const std::string svg = read(page_folder() / "work_precision.svg");
  EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
  EXPECT_NE(svg.find("CPU time of the whole solve"), std::string::npos);
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "no browser: install Debian's chromium (sh tests/run.sh does)";
  for (const int width : {1280, 390}) expect_charts_at(program, width);
}

} // namespace
} // namespace host::chart::chart_page_test
