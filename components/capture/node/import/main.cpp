// `import_carmen LOG -o CAPTURE`: a CARMEN log as an MCAP capture.
#include <CLI/CLI.hpp>
#include <iostream>

#include "capture/node/import/carmen_import.hpp"

namespace {

int run(int argc, char** argv) {
  std::string log;
  std::string capture;
  std::vector<double> mount;
  CLI::App app("A CARMEN log as a capture of scan, odom, tf and tf_static", "import_carmen");
  app.add_option("LOG", log)->required()->check(CLI::ExistingFile);
  app.add_option("-o,--output", capture, "the MCAP file to write")->required();
  app.add_option("--laser", mount, "laser_link in base_link: x y yaw (m, rad); default 0 0 0")
      ->expected(3);
  CLI11_PARSE(app, argc, argv);

  coop::carmen::ReadReport read;
  auto records = coop::carmen::read_log(log, &read);
  coop::capture::CarmenImportOptions options;
  if (!mount.empty()) options.laser_in_base = {mount[0], mount[1], mount[2]};
  coop::mcap::WriterOptions writing;
  writing.when_full = coop::mcap::WhenFull::kWait;
  coop::mcap::Writer writer(coop::mcap::Series{.path = capture}, writing);
  const auto report = coop::capture::import_carmen(std::move(records), options, writer);
  writer.close();
  const auto status = writer.status();
  if (!status.error.empty()) throw std::runtime_error(status.error);
  std::cout << capture << ": " << report.scans << " scans and " << report.odometry
            << " odometry readings of " << read.lines << " lines";
  if (read.other_messages > 0) std::cout << ", " << read.other_messages << " of other kinds";
  if (report.mended_stamps > 0) std::cout << ", " << report.mended_stamps << " stamps mended";
  if (read.truncated_line > 0) std::cout << ", the last line is cut short";
  std::cout << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "import_carmen: " << error.what() << '\n';
    return 2;
  }
}
