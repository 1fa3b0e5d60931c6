// The node's side of the doctor, alone: doctor_node farm doctor-on-node DIR
#include "farm/slurm/doctor.hpp"

int main(int, char** arguments) { lobelia::doctor_on_node(arguments[3]); }
