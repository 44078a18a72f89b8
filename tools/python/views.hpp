#pragma once
// Numbers of a C++ object as NumPy arrays, without a copy.
//
// An array keeps the object alive, and may be read at any time. It shows the current numbers. While an array exists,
// nothing may be added that would move the numbers in memory: the object checks Views first, and the caller gets a
// BufferError, as from a bytearray.
#include <pybind11/numpy.h>

#include <string>
#include <vector>

namespace spook {

namespace py = pybind11;

class Views {
 public:
  /// A read-only array of the first `columns` numbers of each of `items`, from the `first` on. It keeps `owner` alive,
  /// whose member this is.
  template <class Item>
  py::array of(const std::vector<Item>& items, py::ssize_t columns, std::size_t first,
               const py::object& owner) {
    struct Loan {
      py::object owner;
      Views& views;
    };
    ++out_;
    const py::capsule base(new Loan{owner, *this}, [](void* loan) {
      --static_cast<Loan*>(loan)->views.out_;
      delete static_cast<Loan*>(loan);
    });
    // An empty vector has no numbers to point at.
    const double* data = items.empty() ? nullptr : items.front().data() + first;
    py::array_t<double> view({static_cast<py::ssize_t>(items.size()), columns},
                             {static_cast<py::ssize_t>(sizeof(Item)), static_cast<py::ssize_t>(sizeof(double))},
                             data, base);
    py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return view;
  }

  /// Throws BufferError while there is a view.
  void require_none(const char* what) const {
    if (out_ > 0)
      throw py::buffer_error(std::string(what) +
                             ": there are arrays that look at the bodies; del them, or copy() them, before; a "
                             "prompt holds its last result as _, a notebook in Out, and a loop its last row");
  }

 private:
  int out_ = 0;
};

}  // namespace spook
