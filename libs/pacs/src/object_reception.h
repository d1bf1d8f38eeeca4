#pragma once
// One object that comes by C-STORE.

class OFCondition;
struct T_ASC_Association;
struct T_DIMSE_C_StoreRQ;

namespace ostia::pacs {

class Intake;

/// Writes the object to disk as it comes, has it checked and answers. What is wrong with it the intake
/// remembers.
OFCondition receive_object(T_ASC_Association* association, unsigned char context, T_DIMSE_C_StoreRQ& request,
                           Intake& intake, int timeout_s);

}  // namespace ostia::pacs
