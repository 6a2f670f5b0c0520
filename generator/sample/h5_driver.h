// How the HDF5 library reaches the disk when it writes. The library cannot recover from a failed write: the file can no longer
// be closed, and the program crashes when it ends. So it never learns of one: after the first failure, which is
// noted, its writes are kept in memory until the file is closed.
#pragma once
#include <hdf5.h>

namespace lamella::h5 {

/// Makes `access` write through this driver. `*error` becomes the system's error number (errno) of the first failure; it
/// must live until the file is closed.
void set_careful_driver(hid_t access, int* error);

}  // namespace lamella::h5
