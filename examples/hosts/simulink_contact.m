% Simulink: a model with EllipticContact.fmu and a growing longitudinal creepage. NOT RUN: we have no MATLAB.
% Usage: build the FMUs, set the folder below, run this script. It needs R2020a or newer and a supported C library.
fmu = fullfile(pwd, 'dist', 'native', 'EllipticContact.fmu');
model = 'elliptic_contact';
new_system(model);
add_block('simulink_extras/FMU Import/FMU', [model '/contact'], 'FMUName', fmu);
set_param(model, 'Solver', 'FixedStepDiscrete', 'FixedStep', '1e-3', 'StopTime', '1');

% Ports are in the order of the inputs in modelDescription.xml; unconnected ports would be 0, which is no load.
ports = get_param([model '/contact'], 'PortHandles');
starts = {'1.08695652173913', '1', '0', '0', '0', '80e3', '8e-5', '20', '0.3'};
names = {'A0', 'B0', 'longitudinal', 'lateral', 'spin', 'normal_force', 'approach', 'speed', 'friction'};
for k = 1:numel(ports.Inport)
    block = [model '/' names{k}];
    if strcmp(names{k}, 'longitudinal')
        add_block('simulink/Sources/Ramp', block, 'slope', '5e-3');
    else
        add_block('simulink/Sources/Constant', block, 'Value', starts{k});
    end
    source = get_param(block, 'PortHandles');
    add_line(model, source.Outport, ports.Inport(k));
end
add_block('simulink/Sinks/To Workspace', [model '/forces'], 'VariableName', 'force_x');
sink = get_param([model '/forces'], 'PortHandles');
add_line(model, ports.Outport(1), sink.Inport);  % force.x is the first output
simulated = sim(model);
plot(simulated.force_x);
