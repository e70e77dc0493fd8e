// base/stream.h - what is kept from one run to the next, as bytes that any machine reads alike.
//
//   stream = chunk, chunk, ..
//   chunk  = name (4 letters), version (u32), size (u64), checksum (u64), `size` bytes
//
// Numbers are little-endian, floats are IEEE 754. A room writes and reads chunks of its own, in the
// same order; which rooms there are, sim says. What went wrong first stays in `status`, and what is
// done afterwards does nothing: so only the end has to be looked at.
#pragma once
#include "base/status.h"
#include "base/types.h"

// ---- writing -----------------------------------------------------------------------------------

// Start from {0}.
typedef struct DpStateWriter
{
    unsigned char* bytes;  // what was written (size); NULL before
    size_t         size;
    size_t         chunk;   // where the open chunk begins
    bool           open;    // a chunk is open
    DpStatus       status;  // DP_OK, DP_NO_MEMORY
} DpStateWriter;

void dp_write_drop(DpStateWriter* writer);

// A chunk begins: `name` has 4 letters, versions count from 1. Chunks do not hold chunks.
void dp_write_chunk(DpStateWriter* writer, const char* name, uint32_t version);
void dp_write_end(DpStateWriter* writer);

void dp_write_u8(DpStateWriter* writer, uint8_t value);
void dp_write_u64(DpStateWriter* writer, uint64_t value);
void dp_write_i64(DpStateWriter* writer, int64_t value);
void dp_write_f64(DpStateWriter* writer, double value);
void dp_write_bytes(DpStateWriter* writer, const void* bytes, size_t count);
void dp_write_ints(DpStateWriter* writer, const int32_t* value, size_t count);
void dp_write_floats(DpStateWriter* writer, const float* value, size_t count);
void dp_write_doubles(DpStateWriter* writer, const double* value, size_t count);
// Floats of which many follow others of the same bits: runs take little.
void dp_write_runs(DpStateWriter* writer, const float* value, size_t count);

// ---- reading -----------------------------------------------------------------------------------

// Bytes are borrowed. Nothing is read beyond them, or beyond the chunk that is open; what is not
// there reads as 0 and makes the status DP_BAD_FILE.
typedef struct DpStateReader
{
    const unsigned char* bytes;
    size_t               size, at;
    size_t               end;     // of the open chunk
    bool                 open;    // a chunk is open
    DpStatus             status;  // DP_OK, DP_BAD_FILE
} DpStateReader;

DpStateReader dp_read_open(const void* bytes, size_t size);

// Does the next chunk have this name?
bool dp_read_is(const DpStateReader* reader, const char* name);
// Open the next chunk: its version, 1..newest. Of another name, newer, cut off, or with a checksum
// that is not that of its bytes: 0, DP_BAD_FILE.
uint32_t dp_read_chunk(DpStateReader* reader, const char* name, uint32_t newest);
// All of the chunk has been read: else DP_BAD_FILE.
void dp_read_end(DpStateReader* reader);

uint8_t  dp_read_u8(DpStateReader* reader);
uint64_t dp_read_u64(DpStateReader* reader);
int64_t  dp_read_i64(DpStateReader* reader);
double   dp_read_f64(DpStateReader* reader);
void     dp_read_bytes(DpStateReader* reader, void* bytes, size_t count);
void     dp_read_ints(DpStateReader* reader, int32_t* value, size_t count);
void     dp_read_floats(DpStateReader* reader, float* value, size_t count);
void     dp_read_doubles(DpStateReader* reader, double* value, size_t count);
void     dp_read_runs(DpStateReader* reader, float* value, size_t count);

// The same numbers where only low <= value <= high makes sense; others, and NaN, are DP_BAD_FILE and
// read as `low`.
int64_t dp_read_int(DpStateReader* reader, int64_t low, int64_t high);
double  dp_read_number(DpStateReader* reader, double low, double high);
// How many things of at least `each` bytes follow (u64): no more than `most`, nor than there are
// bytes for, so that memory can be asked for. each > 0
size_t dp_read_count(DpStateReader* reader, size_t max_count, size_t each);
// What was read makes no sense unless `holds`: DP_BAD_FILE.
void dp_read_check(DpStateReader* reader, bool holds);
