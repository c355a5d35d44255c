/* SPDX-License-Identifier: MIT
   What a program sees of the library. Everything else is hidden inside it. */
#ifndef OCTOCELL_EXPORT_H
#define OCTOCELL_EXPORT_H

#define OCTOCELL_API __attribute__((visibility("default")))

#endif
