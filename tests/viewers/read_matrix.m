% Reads form-factor matrices with Octave, and prints what it read as lines `ROW COLUMN VALUE`, from 0.
%
%   octave-cli read_matrix.m FILE.mtx|FILE.csv
file = argv(){1};
if strcmp(file(end-3:end), '.mtx')
  text = fileread(file);
  lines = strsplit(text, "\n");
  lines = lines(cellfun(@(line) !isempty(line) && line(1) != '%', lines));
  numbers = sscanf(strjoin(lines, "\n"), '%f', [3, Inf])';
  size_of = numbers(1, :);
  F = sparse(numbers(2:end, 1), numbers(2:end, 2), numbers(2:end, 3), size_of(1), size_of(2));
else
  stream = fopen(file);
  fgetl(stream);  % from,to,form_factor
  fields = textscan(stream, '%s %s %s', 'Delimiter', ',');  % its %f does not round correctly
  fclose(stream);
  from = str2double(fields{1});
  facets = max(from) + 1;
  to = str2double(fields{2});
  to(strcmp(fields{2}, 'surroundings')) = facets;
  to(strcmp(fields{2}, 'backs')) = facets + 1;
  F = sparse(from + 1, to + 1, str2double(fields{3}), facets, facets + 2);
end
printf("octave %s %d %d %d\n", version(), rows(F), columns(F), nnz(F));
for row = 1:rows(F)
  [unused, column, value] = find(F(row, :));
  printf("%d %d %.17g\n", [repmat(row - 1, 1, numel(column)); column(:)' - 1; value(:)']);
end
