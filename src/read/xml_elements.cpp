#include "read/xml_elements.h"

#include <algorithm>

#include "text/text_lines.h"

namespace gaussmesh {
namespace {

bool is_space(char c) { return is_blank(c) || c == '\n' || c == '\r'; }

bool is_name_part(char c) { return is_letter(c) || is_digit(c) || c == '_' || c == ':' || c == '-' || c == '.'; }

}  // namespace

XmlElements::XmlElements(std::string_view bytes, std::string_view file, std::string_view last)
    : bytes_(bytes), file_(file), last_(last) {
  while (position_ < bytes_.size()) {
    const std::size_t begin = position_;
    position_ = std::min(bytes_.find('<', position_), bytes_.size());
    const bool is_first_text = !open_.empty() && open_.back() + 1 == elements_.size();
    if (is_first_text && elements_.back().text.empty()) elements_.back().text = bytes_.substr(begin, position_ - begin);
    if (position_ < bytes_.size()) read_tag();
  }
  if (!open_.empty()) fail_here("the end of <" + std::string(elements_[open_.back()].name) + ">");
}

const XmlElement* XmlElements::find(std::string_view name, std::optional<std::size_t> parent) const {
  const auto is_it = [&](const XmlElement& element) { return element.name == name && element.parent == parent; };
  const auto at = std::find_if(elements_.begin(), elements_.end(), is_it);
  return at == elements_.end() ? nullptr : &*at;
}

void XmlElements::read_tag() {
  const std::string_view rest = bytes_.substr(position_);
  if (rest.starts_with("<?")) {
    skip_until("?>");
  } else if (rest.starts_with("<!--")) {
    skip_until("-->");
  } else if (rest.starts_with("</")) {
    read_end();
  } else {
    read_start();
  }
}

void XmlElements::skip_until(std::string_view end) {
  const std::size_t at = bytes_.find(end, position_);
  if (at == std::string_view::npos) fail_here(end);
  position_ = at + end.size();
}

void XmlElements::read_end() {
  position_ += 2;
  if (open_.empty() || read_name() != elements_[open_.back()].name) fail_here("the end of the element that is open");
  skip_blanks();
  require('>');
  open_.pop_back();
}

void XmlElements::read_start() {
  XmlElement element;
  element.position = position_++;
  element.name = read_name();
  if (element.name.empty()) fail_here("the name of an element");
  if (!open_.empty()) element.parent = open_.back();
  for (skip_blanks(); position_ < bytes_.size() && is_name_part(bytes_[position_]); skip_blanks()) {
    const std::string_view key = read_name();
    skip_blanks();
    require('=');
    skip_blanks();
    const char quote = position_ < bytes_.size() && bytes_[position_] == '\'' ? '\'' : '"';
    require(quote);
    const std::size_t end = bytes_.find(quote, position_);
    if (end == std::string_view::npos) fail_here("the end of a value");
    element.attributes.emplace_back(key, bytes_.substr(position_, end - position_));
    position_ = end + 1;
  }
  const bool is_empty = position_ < bytes_.size() && bytes_[position_] == '/';
  if (is_empty) ++position_;
  require('>');
  const bool is_last = element.name == last_ && !is_empty;
  if (is_last) {
    element.text = bytes_.substr(position_);
    position_ = bytes_.size();
    open_.clear();
  } else if (!is_empty) {
    open_.push_back(elements_.size());
  }
  elements_.push_back(std::move(element));
}

std::string_view XmlElements::read_name() {
  const std::size_t begin = position_;
  while (position_ < bytes_.size() && is_name_part(bytes_[position_])) ++position_;
  return bytes_.substr(begin, position_ - begin);
}

void XmlElements::skip_blanks() {
  while (position_ < bytes_.size() && is_space(bytes_[position_])) ++position_;
}

void XmlElements::require(char c) {
  if (position_ >= bytes_.size() || bytes_[position_] != c) fail_here(std::string({'\'', c, '\''}));
  ++position_;
}

void XmlElements::fail_here(std::string_view expected) const {
  const std::string_view rest = bytes_.substr(std::min(position_, bytes_.size()));
  fail_at_position(position_, expected, rest.empty() ? "end of file" : rest.substr(0, rest.find('\n')), {});
}

void XmlElements::fail_at_position(std::size_t position, std::string_view expected, std::string_view got,
                                   std::string_view remedy) const {
  const std::string_view before = bytes_.substr(0, position);
  const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  fail_at({file_, line}, expected, got, remedy);
}

}  // namespace gaussmesh
