// A reader of JSON. Given: nothing to write here.
#include "json.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace json {

// A recursive descent over the text. Every function reads one value, and leaves `at` behind it.
class Parser {
public:
    explicit Parser(const std::string& text) : text_(text) {}

    Value whole_text() {
        Value value = any(0);
        skip_space();
        if (at_ != text_.size()) {
            fail("the text goes on behind the value");
        }
        return value;
    }

private:
    // Arrays and objects within each other; a deeper text would exhaust the stack.
    static constexpr int MOST_DEEP = 100;

    const std::string& text_;
    std::size_t at_ = 0;

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(what + ", at byte " + std::to_string(at_) + " of the JSON");
    }

    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    bool is_digit() const { return peek() >= '0' && peek() <= '9'; }

    void skip_space() {
        while (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r') {
            ++at_;
        }
    }

    bool take(char c) {
        const bool is_there = at_ < text_.size() && text_[at_] == c;
        at_ += is_there ? 1 : 0;
        return is_there;
    }

    void expect(char c) {
        if (!take(c)) {
            fail(std::string("expected `") + c + "`");
        }
    }

    // Takes `c` behind white space.
    bool take_next(char c) {
        skip_space();
        return take(c);
    }

    void word(const char* word) {
        for (const char* c = word; *c != '\0'; ++c) {
            expect(*c);
        }
    }

    Value any(int depth) {
        skip_space();
        Value value;
        switch (peek()) {
            case '{': object(value, depth + 1); break;
            case '[': array(value, depth + 1); break;
            case '"':
                value.kind_ = Value::Kind::String;
                value.string_ = string();
                break;
            case 'n': word("null"); break;
            case 't':
            case 'f':
                value.kind_ = Value::Kind::Bool;
                value.boolean_ = peek() == 't';
                word(value.boolean_ ? "true" : "false");
                break;
            default:
                value.kind_ = Value::Kind::Number;
                value.number_ = number();
        }
        return value;
    }

    void object(Value& value, int depth) {
        check(depth);
        value.kind_ = Value::Kind::Object;
        expect('{');
        if (take_next('}')) {
            return;
        }
        do {
            skip_space();
            std::string key = string();
            skip_space();
            expect(':');
            value.object_.emplace_back(std::move(key), any(depth));
        } while (take_next(','));
        expect('}');
    }

    void array(Value& value, int depth) {
        check(depth);
        value.kind_ = Value::Kind::Array;
        expect('[');
        if (take_next(']')) {
            return;
        }
        do {
            value.array_.push_back(any(depth));
        } while (take_next(','));
        expect(']');
    }

    void check(int depth) const {
        if (depth > MOST_DEEP) {
            fail("arrays and objects are nested too deep");
        }
    }

    void digits() {
        if (!is_digit()) {
            fail("expected a digit");
        }
        while (is_digit()) {
            ++at_;
        }
    }

    double number() {
        const std::size_t start = at_;
        take('-');
        if (!take('0')) {
            digits();
        }
        if (take('.')) {
            digits();
        }
        if (take('e') || take('E')) {
            if (!take('+')) {
                take('-');
            }
            digits();
        }
        return std::strtod(text_.substr(start, at_ - start).c_str(), nullptr);
    }

    std::string string() {
        std::string text;
        expect('"');
        while (!take('"')) {
            if (at_ == text_.size()) {
                fail("a string without an end");
            }
            const char c = text_[at_];
            if (static_cast<unsigned char>(c) < 0x20) {
                fail("a control character in a string");
            }
            ++at_;
            c == '\\' ? escape(text) : text.push_back(c);
        }
        return text;
    }

    void escape(std::string& text) {
        static const std::string names = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
        const std::size_t which = at_ < text_.size() ? names.find(text_[at_]) : std::string::npos;
        if (which != std::string::npos) {
            ++at_;
            text.push_back(meanings[which]);
            return;
        }
        expect('u');
        unsigned long code = hexadecimal();
        if (code >= 0xD800 && code < 0xDC00) {
            word("\\u");
            const unsigned long low = hexadecimal();
            if (low < 0xDC00 || low >= 0xE000) {
                fail("half of a character");
            }
            code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
        } else if (code >= 0xDC00 && code < 0xE000) {
            fail("half of a character");
        }
        append_utf8(text, code);
    }

    unsigned long hexadecimal() {
        unsigned long code = 0;
        for (int n = 0; n < 4; ++n, ++at_) {
            const char c = peek();
            const std::size_t digit = c == '\0' ? std::string::npos : DIGITS.find(c);
            if (digit == std::string::npos) {
                fail("expected four hexadecimal digits");
            }
            code = 16 * code + (digit < 16 ? digit : digit - 6);
        }
        return code;
    }

    static void append_utf8(std::string& text, unsigned long code) {
        const auto push = [&text](unsigned long byte) { text.push_back(static_cast<char>(byte)); };
        if (code < 0x80) {
            push(code);
        } else if (code < 0x800) {
            push(0xC0 | code >> 6);
            push(0x80 | (code & 0x3F));
        } else if (code < 0x10000) {
            push(0xE0 | code >> 12);
            push(0x80 | (code >> 6 & 0x3F));
            push(0x80 | (code & 0x3F));
        } else {
            push(0xF0 | code >> 18);
            push(0x80 | (code >> 12 & 0x3F));
            push(0x80 | (code >> 6 & 0x3F));
            push(0x80 | (code & 0x3F));
        }
    }

    // The value of a digit is its place; that of a capital is 6 less.
    inline static const std::string DIGITS = "0123456789abcdefABCDEF";
};

Value parse(const std::string& text) { return Parser(text).whole_text(); }

bool Value::boolean() const {
    if (kind_ != Kind::Bool) {
        throw Error("expected true or false");
    }
    return boolean_;
}

const std::string& Value::string() const {
    if (kind_ != Kind::String) {
        throw Error("expected a string");
    }
    return string_;
}

const std::vector<Value>& Value::array() const {
    if (kind_ != Kind::Array) {
        throw Error("expected a list");
    }
    return array_;
}

double Value::number() const {
    if (kind_ == Kind::Number) {
        return number_;
    }
    const double infinite = std::numeric_limits<double>::infinity();
    if (kind_ == Kind::String && string_ == "inf") {
        return infinite;
    }
    if (kind_ == Kind::String && string_ == "-inf") {
        return -infinite;
    }
    if (kind_ == Kind::String && string_ == "nan") {
        return std::numeric_limits<double>::quiet_NaN();
    }
    throw Error("expected a number");
}

unsigned Value::whole() const {
    const double value = number();
    if (!(value >= 0.0 && value <= 4294967295.0 && value == std::floor(value))) {
        throw Error("expected a whole number that is not negative");
    }
    return static_cast<unsigned>(value);
}

const Value* Value::find(const char* key) const {
    if (kind_ != Kind::Object) {
        throw Error(std::string("expected an object with the key `") + key + "`");
    }
    for (const auto& [name, value] : object_) {
        if (name == key) {
            return &value;
        }
    }
    return nullptr;
}

const Value& Value::operator[](const char* key) const {
    if (const Value* value = find(key)) {
        return *value;
    }
    throw Error(std::string("the key `") + key + "` is missing");
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            char code[8];
            std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
            out += code;
        } else {
            out += c;
        }
    }
    return out + "\"";
}

std::string number(double x) {
    if (std::isnan(x)) {
        return "\"nan\"";
    }
    if (std::isinf(x)) {
        return x > 0.0 ? "\"inf\"" : "\"-inf\"";
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
}

}  // namespace json
