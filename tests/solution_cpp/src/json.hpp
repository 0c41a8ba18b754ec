// A reader of JSON (RFC 8259), and the few lines that write it. Given: nothing to write here.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace json {

// A text that is no JSON, or a value that is not what was expected. The message says which.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// A value of JSON.
class Value {
public:
    enum class Kind { Null, Bool, Number, String, Array, Object };

    Kind kind() const { return kind_; }
    bool is_null() const { return kind_ == Kind::Null; }

    // The value as what it is expected to be; an Error if it is something else.
    bool boolean() const;
    const std::string& string() const;
    const std::vector<Value>& array() const;

    // A number. The strings "inf", "-inf" and "nan" stand for numbers that JSON cannot write.
    double number() const;

    // A whole number of at most 32 bits.
    unsigned whole() const;

    // The value of a key of an object; an Error if the object lacks it.
    const Value& operator[](const char* key) const;

    // The value of a key of an object, or a null pointer.
    const Value* find(const char* key) const;

private:
    friend class Parser;

    Kind kind_ = Kind::Null;
    bool boolean_ = false;
    double number_ = 0.0;
    std::string string_;
    std::vector<Value> array_;
    std::vector<std::pair<std::string, Value>> object_;
};

// Reads a text that holds one value and nothing else.
Value parse(const std::string& text);

// Returns the JSON of a text, with its quotes.
std::string quoted(const std::string& text);

// Returns the JSON of a number with all its digits. Infinities and NaN are strings.
std::string number(double x);

}  // namespace json
