#pragma once
/// \file A library's options as keyword arguments. Their names, defaults and types are those of the struct:
/// OSTIA_OPTIONS names each member once, and does not compile where one is missing.

#include "array.h"
#include "errors.h"

#include "ostia/core/error.h"
#include "ostia/geometry/tri_mesh.h"

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// Applies a macro to each of its arguments.
#define OSTIA_NOTHING ()
#define OSTIA_AGAIN(...) OSTIA_AGAIN_2(OSTIA_AGAIN_2(OSTIA_AGAIN_2(OSTIA_AGAIN_2(__VA_ARGS__))))
#define OSTIA_AGAIN_2(...) OSTIA_AGAIN_3(OSTIA_AGAIN_3(OSTIA_AGAIN_3(OSTIA_AGAIN_3(__VA_ARGS__))))
#define OSTIA_AGAIN_3(...) OSTIA_AGAIN_4(OSTIA_AGAIN_4(__VA_ARGS__))
#define OSTIA_AGAIN_4(...) __VA_ARGS__
#define OSTIA_EACH(macro, ...) __VA_OPT__(OSTIA_AGAIN(OSTIA_EACH_STEP(macro, __VA_ARGS__)))
#define OSTIA_EACH_STEP(macro, one, ...) \
  macro(one) __VA_OPT__(OSTIA_EACH_NEXT OSTIA_NOTHING(macro, __VA_ARGS__))
#define OSTIA_EACH_NEXT() OSTIA_EACH_STEP
#define OSTIA_VISIT_MEMBER(name) visitor(#name, options.name);
#define OSTIA_LIST(...) __VA_ARGS__

/// OSTIA_OPTIONS(Type, (members that are given from Python), (all others)). Both lists together are all
/// members in their order but for that the others come last: the structured binding counts them.
#define OSTIA_OPTIONS(Type, given, others)                                         \
  template <>                                                                      \
  struct OptionsOf<Type> {                                                         \
    static constexpr bool known = true;                                            \
    template <class Visitor>                                                       \
    static void visit(Type& options, Visitor&& visitor) {                          \
      OSTIA_COUNT(options, OSTIA_LIST given OSTIA_BEFORE others OSTIA_LIST others) \
      OSTIA_EACH(OSTIA_VISIT_MEMBER, OSTIA_LIST given)                             \
    }                                                                              \
  };
#define OSTIA_BEFORE(...) __VA_OPT__(, )
#define OSTIA_COUNT(options, ...) [[maybe_unused]] const auto& [__VA_ARGS__] = options;

namespace ostia::python {

template <class T>
struct OptionsOf {
  static constexpr bool known = false;
};
/// The words of an enumeration: `static constexpr std::array<std::pair<const char*, E>, N> words`.
template <class E>
struct WordsOf;

template <class T>
void take(T& value, const py::handle& given, const std::string& name);

namespace detail {

/// A word of Python's own gets the underscore that it has there by custom.
inline std::string spelled(const char* name) {
  const std::string word = name;
  return word == "lambda" || word == "from" ? word + "_" : word;
}
inline std::string type_name(const py::handle& given) {
  return py::str(py::type::handle_of(given).attr("__name__")).cast<std::string>();
}
[[noreturn]] inline void wrong_type(const std::string& name, const char* wanted, const py::handle& given) {
  refuse_call(name + ": " + wanted + ", not " + type_name(given) + " " + py::repr(given).cast<std::string>());
}
/// "step_mm=0.1, recentre=True".
inline std::string listed(const py::dict& values) {
  std::string list;
  for (const auto& [name, value] : values)
    list += (list.empty() ? "" : ", ") + py::str(name).cast<std::string>() + "=" +
            py::repr(value).cast<std::string>();
  return list;
}
template <class E>
std::string words_text() {
  std::string text;
  for (const auto& [word, value] : WordsOf<E>::words) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}
template <class E>
const char* word_of(E value) {
  for (const auto& [word, one] : WordsOf<E>::words)
    if (one == value) return word;
  return "?";
}
template <class T>
struct Optional : std::false_type {};
template <class T>
struct Optional<std::optional<T>> : std::true_type {
  using Value = T;
};
template <class T>
struct Shared : std::false_type {};
template <class T>
struct Shared<std::shared_ptr<const T>> : std::true_type {
  using Value = T;
};
template <class T>
struct Vector : std::false_type {};
template <class T>
struct Vector<std::vector<T>> : std::true_type {
  using Value = T;
};

}  // namespace detail

/// Members by name from a dictionary; `where` stands before their names in refusals: "sizing.".
template <class T>
void take_members(T& options, const py::dict& given, const std::string& where) {
  std::size_t used = 0;
  std::string names;
  OptionsOf<T>::visit(options, [&](const char* member_name, auto& member) {
    const std::string name = detail::spelled(member_name);
    names += (names.empty() ? "" : ", ") + name;
    if (!given.contains(name)) return;
    ++used;
    take(member, given[name.c_str()], where + name);
  });
  if (used == given.size()) return;
  for (const auto& [key, value] : given) {
    bool known = false;
    const std::string word = py::str(key).cast<std::string>();
    OptionsOf<T>::visit(options,
                        [&](const char* name, auto&) { known = known || word == detail::spelled(name); });
    if (!known) refuse_call("there is no option " + where + word + "; there are " + names);
  }
}

template <class T>
void take(T& value, const py::handle& given, const std::string& name) {
  if constexpr (detail::Optional<T>::value) {
    if (given.is_none()) return value.reset();
    typename detail::Optional<T>::Value inner = value.value_or(typename detail::Optional<T>::Value{});
    take(inner, given, name);
    value = std::move(inner);
  } else if constexpr (detail::Shared<T>::value) {
    if (given.is_none()) return value.reset();
    typename detail::Shared<T>::Value inner;
    take(inner, given, name);
    value = std::make_shared<const typename detail::Shared<T>::Value>(std::move(inner));
  } else if constexpr (OptionsOf<T>::known) {
    if (!py::isinstance<py::dict>(given)) detail::wrong_type(name, "a dictionary of options", given);
    take_members(value, py::reinterpret_borrow<py::dict>(given), name + ".");
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!PyBool_Check(given.ptr()) && detail::type_name(given) != "bool_")
      detail::wrong_type(name, "True or False", given);
    value = PyObject_IsTrue(given.ptr()) == 1;
  } else if constexpr (std::is_enum_v<T>) {
    if (!py::isinstance<py::str>(given)) detail::wrong_type(name, "a word", given);
    const auto word = given.cast<std::string>();
    for (const auto& [one, meant] : WordsOf<T>::words)
      if (word == one) {
        value = meant;
        return;
      }
    throw InvalidInput(name + ": one of " + detail::words_text<T>() + ", not \"" + word + "\"");
  } else if constexpr (std::is_integral_v<T>) {
    if (PyBool_Check(given.ptr()) || PyIndex_Check(given.ptr()) == 0)
      detail::wrong_type(name, "a whole number", given);
    const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
    if (!whole) throw py::error_already_set();
    try {
      value = whole.cast<T>();
    } catch (const py::cast_error&) {
      throw InvalidInput(name + ": " + py::str(whole).cast<std::string>() + " is out of range");
    }
  } else if constexpr (std::is_floating_point_v<T>) {
    if (PyBool_Check(given.ptr()) || PyNumber_Check(given.ptr()) == 0)
      detail::wrong_type(name, "a number", given);
    value = PyFloat_AsDouble(given.ptr());
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    if (std::isnan(value)) throw InvalidInput(name + ": not a number");
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!py::isinstance<py::str>(given)) detail::wrong_type(name, "a text", given);
    value = given.cast<std::string>();
  } else if constexpr (std::is_same_v<T, geometry::Vec3>) {
    value = place_of(py::reinterpret_borrow<py::object>(given), name);
  } else if constexpr (std::is_same_v<T, std::map<std::string, double>>) {
    if (!py::isinstance<py::dict>(given)) detail::wrong_type(name, "a dictionary of numbers", given);
    value.clear();
    for (const auto& [key, number] : py::reinterpret_borrow<py::dict>(given)) {
      const std::string word = py::str(key).cast<std::string>();
      take(value[word], number, name + "['" + word + "']");
    }
  } else if constexpr (std::is_same_v<T, std::vector<geometry::Vec3>>) {
    value = places_of(py::reinterpret_borrow<py::object>(given), name);
  } else if constexpr (std::is_same_v<T, geometry::TriMesh>) {
    if (!py::isinstance<T>(given)) detail::wrong_type(name, "a TriMesh", given);
    value = given.cast<const T&>();
  } else {
    static_assert(detail::Vector<T>::value, "no way from Python for this type of option");
    if (py::isinstance<py::str>(given) || !py::isinstance<py::iterable>(given))
      detail::wrong_type(name, "a list", given);
    value.clear();
    for (const py::handle one : py::reinterpret_borrow<py::object>(given)) {
      typename detail::Vector<T>::Value item{};
      take(item, one, name + "[" + std::to_string(value.size()) + "]");
      value.push_back(std::move(item));
    }
  }
}

/// Options from a call's keyword arguments. Throws UsageError (an unknown name, another type); what the
/// values may be is said by the library's own `validate`.
template <class T>
T options_of(const py::kwargs& given) {
  T options;
  take_members(options, given, "");
  return options;
}

template <class T>
py::object shown(const T& value);

/// The struct as a dictionary of its members' values: defaults, for documentation and tests.
template <class T>
py::dict members_shown(T options) {
  py::dict members;
  OptionsOf<T>::visit(options, [&](const char* name, auto& member) {
    members[detail::spelled(name).c_str()] = shown(member);
  });
  return members;
}
template <class T>
py::object shown(const T& value) {
  if constexpr (detail::Optional<T>::value) {
    return value ? shown(*value) : py::none();
  } else if constexpr (detail::Shared<T>::value) {
    return py::none();  // of what has a default there is none
  } else if constexpr (OptionsOf<T>::known) {
    return members_shown(value);
  } else if constexpr (std::is_enum_v<T>) {
    return py::str(detail::word_of(value));
  } else if constexpr (std::is_same_v<T, geometry::Vec3>) {
    return tuple_of(value);
  } else if constexpr (detail::Vector<T>::value) {
    py::list list;
    for (const auto& one : value) list.append(shown(one));
    return list;
  } else if constexpr (std::is_same_v<T, std::map<std::string, double>>) {
    py::dict numbers;
    for (const auto& [name, number] : value) numbers[name.c_str()] = number;
    return numbers;
  } else {
    return py::cast(value);
  }
}

/// What is none unless it is given, and lists: the defaults of the options in them, by the option's name.
template <class T>
void note_given(py::dict& table, T options) {
  OptionsOf<T>::visit(options, [&](const char* name, auto& member) {
    using Member = std::remove_cvref_t<decltype(member)>;
    [[maybe_unused]] const auto note = [&]<class Inner>(std::type_identity<Inner>) {
      if constexpr (OptionsOf<Inner>::known) {
        table[detail::spelled(name).c_str()] = members_shown(Inner{});
        note_given(table, Inner{});
      }
    };
    if constexpr (OptionsOf<Member>::known) {
      note_given(table, member);
    } else if constexpr (detail::Optional<Member>::value) {
      note(std::type_identity<typename detail::Optional<Member>::Value>{});
    } else if constexpr (detail::Vector<Member>::value) {
      note(std::type_identity<typename detail::Vector<Member>::Value>{});
    }
  });
}

/// Notes a function's options in the module's tables `_options` and `_options_given`, and gives the sentences
/// that its help ends with.
template <class T>
std::string with_options(py::module_& m, const char* function, const std::string& text) {
  for (const char* table : {"_options", "_options_given"})
    if (!py::hasattr(m, table)) m.attr(table) = py::dict();
  const py::dict defaults = members_shown(T{});
  m.attr("_options")[function] = defaults;
  py::dict given;
  note_given(given, T{});
  m.attr("_options_given")[function] = given;
  return text + "\n\nOptions, by keyword: " + detail::listed(defaults) +
         (given.empty() ? "" : "\nOptions in those, where they are given: " + detail::listed(given));
}

}  // namespace ostia::python
