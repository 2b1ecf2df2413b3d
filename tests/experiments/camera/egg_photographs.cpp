// egg_photographs <folder with truth.csv> [folder for pictures]: counts eggs in
// photographs of nest boxes and holds the counts against the true ones and their author's
// detector's.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>

#include "camera_driver/photograph.hpp"

namespace coop::camera_driver {
namespace {

struct Score {
  int pictures = 0;
  int exact = 0;
  int error = 0;

  void add(int found, int truth) {
    ++pictures;
    exact += found == truth ? 1 : 0;
    error += std::abs(found - truth);
  }
  void print(const char* who) const {
    std::printf("%-40s %2d of %2d exact, mean absolute error %.2f\n", who, exact, pictures,
                static_cast<double>(error) / std::max(1, pictures));
  }
};

void draw(const cv::Mat& picture, const std::vector<PhotographedEgg>& eggs,
          const std::string& path) {
  cv::Mat drawn = picture.clone();
  for (const PhotographedEgg& egg : eggs) {
    const Blob& e = egg.ellipse;
    cv::ellipse(drawn, cv::Point2d(e.column, e.row), cv::Size2d(e.half_long, e.half_short),
                e.angle * 57.29578, 0, 360, {0, 255, 0}, 2);
    char text[16];
    std::snprintf(text, sizeof text, "%.2f", egg.score);
    cv::putText(drawn, text, cv::Point2d(e.column - 20, e.row), cv::FONT_HERSHEY_SIMPLEX, 0.5,
                {0, 255, 0});
  }
  cv::imwrite(path, drawn);
}

int run(const std::string& folder, const std::string& output) {
  std::ifstream truth(folder + "/truth.csv");
  if (!truth) {
    std::fprintf(stderr, "no truth.csv in %s\n", folder.c_str());
    return 1;
  }
  Score all, published, tuned, held_out, without_hens;
  std::string line;
  std::getline(truth, line);
  for (int i = 0; std::getline(truth, line); ++i) {
    std::istringstream fields(line);
    std::string name, number, hens, theirs;
    std::getline(fields, name, ',');
    std::getline(fields, number, ',');
    std::getline(fields, hens, ',');
    std::getline(fields, theirs, ',');
    const cv::Mat picture = cv::imread(folder + "/" + name);
    cv::Mat rgb;
    cv::cvtColor(picture, rgb, cv::COLOR_BGR2RGB);
    const auto eggs = find_eggs({}, rgb);
    const int found = static_cast<int>(eggs.size());
    std::printf("%s: %d eggs, found %d, author's detector %s\n", name.c_str(), std::stoi(number),
                found, theirs.c_str());
    all.add(found, std::stoi(number));
    published.add(std::stoi(theirs), std::stoi(number));
    (i % 2 == 0 ? tuned : held_out).add(found, std::stoi(number));
    if (hens == "0") without_hens.add(found, std::stoi(number));
    if (!output.empty()) draw(picture, eggs, output + "/photo_" + std::to_string(i) + ".png");
  }
  all.print("all");
  tuned.print("those looked at while tuning (even)");
  held_out.print("the others (odd)");
  without_hens.print("without hens");
  published.print("their author's detector, all");
  return 0;
}

}  // namespace
}  // namespace coop::camera_driver

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: egg_photographs <folder> [folder for pictures]\n");
    return 2;
  }
  return coop::camera_driver::run(argv[1], argc > 2 ? argv[2] : "");
}
