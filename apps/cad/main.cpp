// keyline-cad: STEP and IGES for room exchange, in a process of its own.
//   keyline-cad read step|iges FILE    prints the document as JSON
//   keyline-cad write step|iges        document as JSON on standard input, prints the file
// A failure is one line "message; remedy" on standard error and exit status 1.
#include <IGESControl_Controller.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_document.h"
#include "keyline/exchange/occt/reader.h"
#include "keyline/exchange/occt/writer.h"

namespace {

namespace exchange = keyline::exchange;

/// Standard output for the answer alone: what libraries print goes nowhere.
class Answer {
 public:
  Answer() : file_(::fdopen(::dup(1), "wb")) {
    if (std::freopen("/dev/null", "w", stdout) == nullptr) std::fclose(stdout);
  }
  ~Answer() {
    if (file_) std::fclose(file_);
  }
  bool write(const std::string& text) {
    return file_ && std::fwrite(text.data(), 1, text.size(), file_) == text.size() &&
           std::fflush(file_) == 0;
  }

 private:
  std::FILE* file_;
};

std::string read(bool step, const std::string& file) {
  const auto document = step ? exchange::occt::read_step(file) : exchange::occt::read_iges(file);
  return exchange::to_json(document).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string write(bool step) {
  const std::string text(std::istreambuf_iterator<char>(std::cin), {});
  const auto document = exchange::read_json(text);
  if (!document) throw std::runtime_error(document.error().message);
  return step ? exchange::occt::write_step(*document) : exchange::occt::write_iges(*document);
}

int run(int argc, char** argv) {
  const std::string task = argc > 1 ? argv[1] : "";
  const std::string format = argc > 2 ? argv[2] : "";
  const bool known = format == "step" || format == "iges";
  if (!known || !((task == "read" && argc == 4) || (task == "write" && argc == 3))) {
    std::cerr << "usage: keyline-cad read step|iges FILE, or write step|iges\n";
    return 2;
  }
  Answer answer;
  STEPControl_Controller::Init();
  IGESControl_Controller::Init();
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  const std::string text =
      task == "read" ? read(format == "step", argv[3]) : write(format == "step");
  return answer.write(text) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    OCC_CATCH_SIGNALS
    return run(argc, argv);
  } catch (const Standard_Failure& failure) {
    std::cerr << "the CAD kernel gives up: " << failure.GetMessageString() << "; check the file\n";
  } catch (const std::bad_alloc&) {
    std::cerr << "the file needs more memory than it may have; split it\n";
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << '\n';
  }
  return 1;
}
